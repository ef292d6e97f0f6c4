"""Storage of bags: whole ones and cut-off ones, of ROS 2 and ROS 1, read and written."""
