"""Parts of the node ``imu_adapter``."""
