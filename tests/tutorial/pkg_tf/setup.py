import os
from glob import glob

from setuptools import find_packages, setup

package_name = 'pkg_tf'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        (os.path.join('share', package_name, 'launch'), glob('launch/*.launch.*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={
        'console_scripts': [
            'turtle_tf_broadcaster = pkg_tf.turtle_tf_broadcaster:main',
            'turtle_following = pkg_tf.turtle_following:main',
            'static_turtle = pkg_tf.static_turtle:main',
            'fixed_carrot = pkg_tf.fixed_carrot:main',
            'dynamic_carrot = pkg_tf.dynamic_carrot:main',
            'first_time_travel = pkg_tf.first_time_travel:main',
            'time_travel = pkg_tf.time_travel:main',
            'point_listener = pkg_tf.point_listener:main',
            'point_sender = pkg_tf.point_sender:main',
            'rotate = pkg_tf.rotate:main',
            'tunable = pkg_tf.tunable:main',
        ],
    },
)
