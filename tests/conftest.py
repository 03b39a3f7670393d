"""What every test shares."""

import os

from hypothesis import settings

# No test compares wall time, so hypothesis may not either; and a build machine draws the
# same examples in every run, so that a red build means a change and not a lucky draw.
settings.register_profile("desk", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "desk")

pytest_plugins = ["pytester", "tftool.ros.pytest_plugin"]
