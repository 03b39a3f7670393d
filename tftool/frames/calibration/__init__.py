"""Calibration of the mount of one moving frame on another, and of clock offsets, from motions."""
