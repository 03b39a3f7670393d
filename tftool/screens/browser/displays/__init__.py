"""What of messages is drawn beside the frames: points and lines, each type in a file of its own."""
