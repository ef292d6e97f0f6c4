"""What all nodes share of ROS: parameters, QoS, messages, diagnostics, start and end."""
