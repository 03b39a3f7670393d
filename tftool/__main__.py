"""`python -m tftool` is the `tftool` command."""

import sys

from tftool.cli.app import main

sys.exit(main())
