"""Client that calls everything that the server offers once, and ends."""

import rclpy
from example_interfaces.action import Fibonacci
from rcl_interfaces.msg import Parameter, ParameterEvent, ParameterType, ParameterValue
from rcl_interfaces.srv import ListParameters, SetParameters
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from std_srvs.srv import SetBool


class Client(Node):
    def __init__(self):
        super().__init__("client")
        latched = QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.map = rclpy.task.Future()
        self.create_subscription(String, "map_name", self.map.set_result, latched)
        self.create_subscription(String, "noise", self.hear_noise, 10)
        self.changed = rclpy.task.Future()
        self.create_subscription(ParameterEvent, "/parameter_events", self.hear_change, 10)

    def hear_noise(self, message):
        self.get_logger().error("the noise was heard")

    def hear_change(self, event):
        if event.node == "/server" and event.changed_parameters and not self.changed.done():
            self.changed.set_result(event.changed_parameters[0])

    def ask(self, kind, name, request):
        client = self.create_client(kind, name)
        if not client.wait_for_service(timeout_sec=180.0):
            raise RuntimeError(f"nobody serves {name}")
        return self.wait(client.call_async(request))

    def wait(self, future):
        rclpy.spin_until_future_complete(self, future, timeout_sec=180.0)
        return future.result()


rclpy.init()
node = Client()
say = node.get_logger().info
answer = node.ask(ListParameters, "/server/list_parameters", ListParameters.Request())
say(f"parameters: {sorted(answer.result.names)}")
for name, value in (
    ("speed", ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=4.5)),
    ("speed", ParameterValue(type=ParameterType.PARAMETER_STRING, string_value="fast")),
):
    change = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
    answer = node.ask(SetParameters, "/server/set_parameters", change)
    say(f"set: {answer.results[0].successful}")
change = node.wait(node.changed)
say(f"changed: {change.name} {change.value.double_value}")
say(f"enabled: {node.ask(SetBool, 'enable', SetBool.Request(data=True))}")
say(f"map: {node.wait(node.map).data}")

action = ActionClient(node, Fibonacci, "fibonacci")
action.wait_for_server(timeout_sec=180.0)
goal = node.wait(action.send_goal_async(Fibonacci.Goal(order=6)))
end = node.wait(goal.get_result_async())
say(f"fibonacci: {end.status} {list(end.result.sequence)}")
