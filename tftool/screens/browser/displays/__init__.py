"""Displays of messages besides frames: points and lines, one file per type."""
