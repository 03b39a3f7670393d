"""TF2 without ROS: coordinate frames over time, and the turtles to learn them with."""

__version__ = "0.1.0"
