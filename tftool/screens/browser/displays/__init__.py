"""Displays of messages beside the frames: points and lines, each type in a file of its own."""
