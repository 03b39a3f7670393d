"""Calibration from recorded motion: the mount of one moving frame on another, and the clocks."""
