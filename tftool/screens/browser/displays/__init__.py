"""Displays of messages besides frames: points, lines and shapes, with one file per type."""
