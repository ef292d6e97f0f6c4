"""The parts of ``imu_adapter``."""
