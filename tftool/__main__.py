"""`python -m tftool` is the `tftool` command."""

import sys

from tftool.app.main import main

sys.exit(main())
