"""Packaging of dualfoot_ros, for ``colcon build`` and for ``pip install`` alike."""

from pathlib import Path

from setuptools import find_packages, setup

NAME = "dualfoot_ros"
NODES = ["bringup", "fusion", "imu_adapter", "live_page", "replay", "time_sync"]


def files(folder: str, pattern: str) -> list[str]:
    """Return the paths of a folder's files, as they are installed."""
    return sorted(str(path) for path in Path(folder).glob(pattern))


# A stock ROS 2 installation brings rclpy and the messages itself; only the extra `ros` asks for
# the wheels.  The presets travel twice: in the ament share, and as package data for `pip`.
setup(
    name=NAME,
    version="0.2.0",
    description="Dual-foot pedestrian inertial navigation for ROS 2",
    license="Apache-2.0",
    maintainer="dualfoot_ros maintainers",
    maintainer_email="maintainers@dualfoot.invalid",
    python_requires=">=3.11",
    packages=[*find_packages(include=[NAME, f"{NAME}.*"]), f"{NAME}.config"],
    package_dir={f"{NAME}.config": "config"},
    package_data={
        f"{NAME}.config": [
            "*.yaml",
            "nodes/*.yaml",
            "paper_noise/*.yaml",
            "rviz/*.rviz",
            "security/*.xml",
            "foxglove/*.json",
        ],
        f"{NAME}.evaluation.reports.html": ["*.css", "*.js"],
        f"{NAME}.nodes.page": ["*.css", "*.js"],
        NAME: ["py.typed"],
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        (f"share/{NAME}/config", files("config", "*.yaml")),
        (f"share/{NAME}/config/nodes", files("config/nodes", "*.yaml")),
        (f"share/{NAME}/config/foxglove", files("config/foxglove", "*.json")),
        (f"share/{NAME}/config/rviz", files("config/rviz", "*.rviz")),
        (f"share/{NAME}/config/security", files("config/security", "*.xml")),
        (f"share/{NAME}/config/paper_noise", files("config/paper_noise", "*.yaml")),
        (f"share/{NAME}/launch", files("launch", "*.launch.*")),
    ],
    zip_safe=False,
    install_requires=[
        "matplotlib>=3.6",
        "numba>=0.58",
        "numpy>=1.26",
        "pyserial>=3.5",
        "PyYAML>=6.0",
        "rich>=13.0",
        "rosbags>=0.10.10",
        "scipy>=1.11",
    ],
    extras_require={
        "ble": ["bleak>=0.21"],
        "cluster": ["distributed>=2024.1"],
        "test": ["pytest", "hypothesis", "selenium>=4.20"],
        "dev": [
            *("mypy", "pytest-xdist", "ruff", "types-PyYAML"),
            *("build>=1.0", "setuptools", "wheel"),
            "mkdocs>=1.6",
        ],
        "ros": ["ros-jazzy-common-interfaces", "ros-jazzy-rclpy[fastrtps]"],
    },
    entry_points={
        "console_scripts": [
            "dualfoot = dualfoot_ros.cli.main:main",
            *(f"{node} = dualfoot_ros.nodes.entry:{node}" for node in NODES),
        ],
    },
)
