"""Calibration from recorded motions: the mount of one moving frame on another, clock offsets."""
