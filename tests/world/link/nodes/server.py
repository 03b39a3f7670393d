"""Server of a switch and an action, with a latched map name, and with noise."""

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from std_srvs.srv import SetBool


class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.declare_parameter("speed", 2.5)
        self.create_service(SetBool, "enable", self.enable)
        self.action = ActionServer(self, Fibonacci, "fibonacci", self.count)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.maps = self.create_publisher(String, "map_name", latched)
        self.maps.publish(String(data="the cellar"))
        self.maps.publish(String(data="the attic"))
        lossy = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.noise = self.create_publisher(String, "noise", lossy)
        self.create_timer(0.1, lambda: self.noise.publish(String(data="zzz")))

    def enable(self, request, response):
        response.success = request.data
        response.message = f"speed {self.get_parameter('speed').value}"
        return response

    def count(self, goal):
        numbers = [0, 1]
        while len(numbers) < goal.request.order:
            numbers.append(numbers[-1] + numbers[-2])
            goal.publish_feedback(Fibonacci.Feedback(sequence=numbers))
        goal.succeed()
        return Fibonacci.Result(sequence=numbers)


rclpy.init()
rclpy.spin(Server())
