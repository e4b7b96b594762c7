"""What others exchange: images, ROS maps, logs."""
