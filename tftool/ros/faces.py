"""Which module and which name of ROS 2 we answer to, and where ours is.

A line is "their module: our module: the names", a name alone or `theirs=ours`.
Packages of interfaces (geometry_msgs and so on) need no line: they follow from
their definitions.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

_TABLE = """
rclpy: client.core: init shutdown try_shutdown ok spin spin_once spin_until_future_complete
rclpy: client.core: create_node get_global_executor get_default_context logging
rclpy: client.core: InitContextManager Context
rclpy: client.parameters: Parameter
rclpy: client.signals: SignalHandlerOptions
rclpy: client.utilities: get_rmw_implementation_identifier
rclpy.node: client.node: Node
rclpy.node: client.parameters: Parameter
rclpy.node: client.node_graph: NodeNameNonExistentError
rclpy.context: client.context: Context
rclpy.time: client.time: Time Duration ClockType
rclpy.duration: client.time: Duration Infinite
rclpy.clock: client.time: Clock ROSClock ClockType ClockChange JumpHandle JumpThreshold TimeJump
rclpy.clock: client.time: Time Duration
rclpy.clock_type: client.time: ClockType
rclpy.constants: client.time: S_TO_NS
rclpy.timer: client.time: Rate
rclpy.timer: client.timers: Timer TimerInfo
rclpy.publisher: client.topics: Publisher
rclpy.subscription: client.topics: Subscription MessageInfo
rclpy.topic_endpoint_info: client.endpoints: TopicEndpointInfo TopicEndpointTypeEnum
rclpy.wait_for_message: client.waiting: wait_for_message
rclpy.client: client.services: Client
rclpy.service: client.services: Service
rclpy.guard_condition: client.entities: GuardCondition
rclpy.task: client.futures: Future Task
rclpy.executors: client.executors: Executor SingleThreadedExecutor MultiThreadedExecutor
rclpy.executors: client.exceptions: ExternalShutdownException ShutdownException
rclpy.executors: client.exceptions: TimeoutException ConditionReachedException
rclpy.callback_groups: client.groups: CallbackGroup MutuallyExclusiveCallbackGroup
rclpy.callback_groups: client.groups: ReentrantCallbackGroup
rclpy.logging: client.logging: get_logger LoggingSeverity set_logger_level initialize shutdown
rclpy.logging: client.logging: get_logger_effective_level get_logging_severity_from_string
rclpy.impl.rcutils_logger: client.logging: RcutilsLogger
rclpy.impl.logging_severity: client.logging: LoggingSeverity
rclpy.parameter: client.parameters: Parameter parameter_value_to_python get_parameter_value
rclpy.parameter: client.parameters: parameter_dict_from_yaml_file PARAMETER_SEPARATOR_STRING
rclpy.parameter_client: client.parameter_client: AsyncParameterClient
rclpy.parameter_event_handler: client.parameter_events: ParameterEventHandler
rclpy.parameter_event_handler: client.parameter_events: ParameterCallbackHandle
rclpy.parameter_event_handler: client.parameter_events: ParameterEventCallbackHandle
rclpy.exceptions: client.exceptions: NotInitializedException ROSInterruptException
rclpy.exceptions: client.exceptions: NameValidationException InvalidHandle ParameterException
rclpy.exceptions: client.exceptions: InvalidNamespaceException InvalidNodeNameException
rclpy.exceptions: client.exceptions: InvalidTopicNameException InvalidServiceNameException
rclpy.exceptions: client.exceptions: NoTypeSupportImportedException
rclpy.exceptions: client.exceptions: ParameterNotDeclaredException
rclpy.exceptions: client.exceptions: ParameterAlreadyDeclaredException
rclpy.exceptions: client.exceptions: InvalidParameterException InvalidParameterTypeException
rclpy.exceptions: client.exceptions: InvalidParameterValueException ParameterImmutableException
rclpy.exceptions: client.exceptions: ParameterUninitializedException
rclpy.qos: client.qos: QoSProfile HistoryPolicy ReliabilityPolicy DurabilityPolicy
rclpy.qos: client.qos: LivelinessPolicy QoSHistoryPolicy QoSReliabilityPolicy
rclpy.qos: client.qos: QoSDurabilityPolicy QoSLivelinessPolicy QoSPresetProfiles
rclpy.qos: client.qos: InvalidQoSProfileException qos_profile_system_default
rclpy.qos: client.qos: qos_profile_unknown qos_profile_best_available QoSPolicyKind
rclpy.qos: client.qos: qos_profile_sensor_data qos_profile_services_default
rclpy.qos: client.qos: qos_profile_parameters qos_profile_parameter_events
rclpy.qos: client.qos: qos_profile_action_status_default
rclpy.action: client.action_client: ActionClient
rclpy.action: client.action_server: ActionServer GoalResponse CancelResponse
rclpy.action.client: client.action_client: ActionClient ClientGoalHandle
rclpy.action.client: client.action_goals: GoalStatus
rclpy.action.server: client.action_server: ActionServer ServerGoalHandle GoalResponse
rclpy.action.server: client.action_server: CancelResponse
rclpy.lifecycle: client.lifecycle: LifecycleNode LifecycleNodeMixin LifecyclePublisher
rclpy.lifecycle: client.lifecycle: LifecycleState TransitionCallbackReturn ManagedEntity
rclpy.lifecycle: client.lifecycle: SimpleManagedEntity Node=LifecycleNode State=LifecycleState
rclpy.lifecycle: client.lifecycle: Publisher=LifecyclePublisher
rclpy.lifecycle.node: client.lifecycle: LifecycleNode LifecycleNodeMixin LifecycleState
rclpy.lifecycle.node: client.lifecycle: TransitionCallbackReturn
rclpy.lifecycle.publisher: client.lifecycle: LifecyclePublisher
rclpy.lifecycle.managed_entity: client.lifecycle: ManagedEntity SimpleManagedEntity
rclpy.serialization: client.serialization: serialize_message deserialize_message
rclpy.signals: client.signals: SignalHandlerOptions
rclpy.utilities: client.utilities: remove_ros_args ok get_default_context timeout_sec_to_nsec
rclpy.utilities: client.utilities: get_rmw_implementation_identifier shutdown try_shutdown
rclpy.expand_topic_name: client.validation: expand_topic_name
rclpy.validate_full_topic_name: client.validation: validate_full_topic_name
rclpy.validate_namespace: client.validation: validate_namespace
rclpy.validate_node_name: client.validation: validate_node_name
rclpy.validate_parameter_name: client.validation: validate_parameter_name
rclpy.validate_topic_name: client.validation: validate_topic_name
message_filters: client.message_filters: Subscriber Cache TimeSynchronizer SimpleFilter
message_filters: client.message_filters: ApproximateTimeSynchronizer
tf2_py: tf.core: BufferCore
tf2_py: tf.errors: TransformException LookupException ConnectivityException TimeoutException
tf2_py: tf.errors: ExtrapolationException InvalidArgumentException
tf2_ros: tf.buffer: Buffer
tf2_ros: tf.core: BufferCore
tf2_ros: tf.interface: BufferInterface
tf2_ros: tf.talking: TransformListener TransformBroadcaster
tf2_ros: tf.talking: StaticTransformBroadcaster StaticTransformListener
tf2_ros: tf.errors: TransformException LookupException ConnectivityException TimeoutException
tf2_ros: tf.errors: ExtrapolationException InvalidArgumentException
tf2_ros: tf.registry: TransformRegistration ConvertRegistration TypeException convert
tf2_ros: tf.registry: NotImplementedException
tf2_ros.buffer: tf.buffer: Buffer
tf2_ros.buffer_interface: tf.interface: BufferInterface
tf2_ros.buffer_interface: tf.registry: TransformRegistration ConvertRegistration TypeException
tf2_ros.buffer_interface: tf.registry: convert NotImplementedException
tf2_ros.transform_listener: tf.talking: TransformListener
tf2_ros.static_transform_listener: tf.talking: StaticTransformListener
tf2_ros.transform_broadcaster: tf.talking: TransformBroadcaster
tf2_ros.static_transform_broadcaster: tf.talking: StaticTransformBroadcaster
tf2_geometry_msgs: tf.do_transform: do_transform_point do_transform_vector3 do_transform_pose
tf2_geometry_msgs: tf.do_transform: do_transform_pose_stamped do_transform_wrench
tf2_geometry_msgs: tf.do_transform: do_transform_wrench_stamped do_transform_polygon_stamped
tf2_geometry_msgs: tf.do_transform: do_transform_pose_with_covariance_stamped
tf2_geometry_msgs: tf.do_transform: transform_covariance to_msg_msg from_msg_msg
tf2_geometry_msgs.tf2_geometry_msgs: tf.do_transform: *
tf2_sensor_msgs: tf.do_transform: do_transform_cloud
tf2_sensor_msgs.tf2_sensor_msgs: tf.do_transform: do_transform_cloud
tf_transformations: tf.euler: quaternion_from_euler euler_from_quaternion euler_from_matrix
tf_transformations: tf.euler: euler_matrix quaternion_matrix quaternion_from_matrix
tf_transformations: tf.euler: quaternion_about_axis quaternion_multiply quaternion_inverse
tf_transformations: tf.euler: quaternion_conjugate quaternion_slerp identity_matrix
tf_transformations: tf.euler: translation_matrix translation_from_matrix inverse_matrix
tf_transformations: tf.euler: concatenate_matrices compose_matrix vector_norm unit_vector
tf_transformations: tf.euler: TRANSLATION_IDENTITY ROTATION_IDENTITY
launch: launching.description: LaunchDescription LaunchDescriptionSource
launch: launching.context: LaunchContext
launch: launching.action: Action
launch: launching.conditions: Condition
launch: launching.events: Event EventHandler
launch: launching.substitutions: Substitution SomeSubstitutionsType
launch: launching.description: LaunchDescriptionEntity LaunchDescriptionSource
launch.action: launching.action: Action
launch.actions: launching.settings: DeclareLaunchArgument SetLaunchConfiguration
launch.actions: launching.settings: UnsetLaunchConfiguration ResetLaunchConfigurations
launch.actions: launching.settings: SetEnvironmentVariable AppendEnvironmentVariable
launch.actions: launching.settings: UnsetEnvironmentVariable PushLaunchConfigurations=Push
launch.actions: launching.settings: PopLaunchConfigurations=Pop
launch.actions: launching.composition: OpaqueFunction GroupAction IncludeLaunchDescription
launch.actions: launching.composition: TimerAction
launch.actions: launching.reactions: LogInfo RegisterEventHandler UnregisterEventHandler EmitEvent
launch.actions: launching.reactions: Shutdown
launch.actions: launching.processes: ExecuteProcess ExecuteLocal=ExecuteProcess
launch.conditions: launching.conditions: IfCondition UnlessCondition LaunchConfigurationEquals
launch.conditions: launching.conditions: LaunchConfigurationNotEquals
launch.event_handlers: launching.events: OnProcessExit OnProcessStart OnShutdown
launch.event_handlers: launching.events: OnExecutionComplete
launch.events: launching.events: Shutdown
launch.events.process: launching.events: ProcessExited ProcessStarted
launch.launch_context: launching.context: LaunchContext
launch.launch_description: launching.description: LaunchDescription
launch.launch_description_source: launching.description: LaunchDescriptionSource
launch.launch_description_sources: launching.description: PythonLaunchDescriptionSource
launch.launch_description_sources: launching.description: AnyLaunchDescriptionSource
launch.launch_description_sources: launching.description: FrontendLaunchDescriptionSource
launch.some_substitutions_type: launching.substitutions: SomeSubstitutionsType
launch.substitution: launching.substitutions: Substitution
launch.substitutions: launching.substitutions: TextSubstitution LaunchConfiguration
launch.substitutions: launching.substitutions: EnvironmentVariable PathJoinSubstitution
launch.substitutions: launching.substitutions: StringJoinSubstitution PythonExpression
launch.substitutions: launching.substitutions: ThisLaunchFile ThisLaunchFileDir AnonName
launch.substitutions: launching.substitutions: FindExecutable Command SubstitutionFailure
launch.substitutions: launching.substitutions: LocalSubstitution
launch.substitutions: launching.logic: EqualsSubstitution NotEqualsSubstitution AndSubstitution
launch.substitutions: launching.logic: OrSubstitution NotSubstitution AnySubstitution
launch.substitutions: launching.logic: AllSubstitution IfElseSubstitution
launch.utilities: launching.substitutions: perform_substitutions=perform
launch_xml.launch_description_sources: launching.description: XMLLaunchDescriptionSource
launch_yaml.launch_description_sources: launching.description: YAMLLaunchDescriptionSource
launch_ros.actions: launching.nodes: Node PushRosNamespace PushROSNamespace=PushRosNamespace
launch_ros.actions: launching.nodes: SetRemap LifecycleNode
launch_ros.actions: launching.parameters: SetParameter SetUseSimTime SetParametersFromFile
launch_ros.substitutions: launching.substitutions: FindPackageShare FindPackagePrefix FindPackage
launch_ros.parameter_descriptions: launching.parameters: ParameterValue ParameterFile
launch_ros.descriptions: launching.parameters: ParameterValue ParameterFile
ament_index_python: launching.packages: get_package_share_directory get_package_prefix
ament_index_python: launching.packages: get_package_share_path PackageNotFoundError
ament_index_python: launching.packages: get_packages_with_prefixes
ament_index_python.packages: launching.packages: get_package_share_directory
ament_index_python.packages: launching.packages: get_package_prefix get_package_share_path
ament_index_python.packages: launching.packages: PackageNotFoundError get_packages_with_prefixes
"""


@dataclass(frozen=True, slots=True)
class Face:
    """One name of a module of theirs.

    Attributes:
        module: Our module, below `tftool.ros`.
        name: Its name there; "*" stands for every public name.
    """

    module: str
    name: str


@cache
def table() -> Mapping[str, Mapping[str, Face]]:
    """Every module we answer to, and its names; parents without names of their own included."""
    found: dict[str, dict[str, Face]] = {}
    for line in _TABLE.strip().splitlines():
        theirs, ours, names = (part.strip() for part in line.split(":", 2))
        for name in names.split():
            shown, _, real = name.partition("=")
            found.setdefault(theirs, {})[shown] = Face(ours, real or shown)
    for module in list(found):
        parent = module.rpartition(".")[0]
        while parent:
            found.setdefault(parent, {})
            parent = parent.rpartition(".")[0]
    return found
