"""Parts of ROS that all nodes share: parameters, QoS, messages, diagnostics, start and end."""
