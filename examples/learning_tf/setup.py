from glob import glob

from setuptools import find_packages, setup

package_name = "learning_tf"

setup(
    name=package_name,
    version="0.0.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        (f"share/{package_name}/launch", glob("launch/*.launch.py")),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    entry_points={
        "console_scripts": [
            "static_frame = learning_tf.static_frame:main",
            "turtle_broadcaster = learning_tf.turtle_broadcaster:main",
            "turtle_follower = learning_tf.turtle_follower:main",
            "fixed_carrot = learning_tf.fixed_carrot:main",
            "moving_carrot = learning_tf.moving_carrot:main",
            "time_traveller = learning_tf.time_traveller:main",
        ],
    },
)
