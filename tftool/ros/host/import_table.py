"""Table of ROS 2's modules and names provided here, and where they are implemented.

A line is "their module: our module: the names", a name alone or `theirs=ours`. A module of ours
with a slash is a package of interfaces; one with a dot in front is a module of tftool outside of
`tftool.ros`. The classes of some modules are found in modules of their own below them as well, as
in ROS 2: `launch.actions.execute_process`. Packages of interfaces (geometry_msgs and so on) need no
line: they follow from their definitions.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

_TABLE = """
rclpy: rclpy.core: init shutdown try_shutdown ok spin spin_once spin_until_future_complete
rclpy: rclpy.core: create_node get_global_executor get_default_context logging
rclpy: rclpy.core: InitContextManager Context List Optional TYPE_CHECKING
rclpy: rclpy.parameters: Parameter
rclpy: rclpy.core: SignalHandlerOptions
rclpy: rclpy.core: get_rmw_implementation_identifier
rclpy.node: rclpy.node: Node
rclpy.node: rclpy.parameters: Parameter
rclpy.node: rclpy.node_graph: NodeNameNonExistentError
rclpy.context: rclpy.context: Context
rclpy.time: rclpy.time: Time Duration ClockType CONVERSION_CONSTANT=S_TO_NS
rclpy.time: rclpy.time: S_TO_NS
rclpy.duration: rclpy.time: Duration Infinite CONVERSION_CONSTANT=S_TO_NS S_TO_NS
rclpy.clock: rclpy.time: Clock ROSClock ClockType ClockChange JumpHandle JumpThreshold TimeJump
rclpy.clock: rclpy.time: Time Duration
rclpy.clock_type: rclpy.time: ClockType
rclpy.constants: rclpy.time: S_TO_NS
rclpy.timer: rclpy.time: Rate
rclpy.timer: rclpy.entities: Timer TimerInfo
rclpy.publisher: rclpy.topics: Publisher
rclpy.subscription: rclpy.topics: Subscription MessageInfo
rclpy.event_handler: rclpy.qos_events: PublisherEventCallbacks SubscriptionEventCallbacks
rclpy.event_handler: rclpy.qos_events: QoSPublisherEventType QoSSubscriptionEventType
rclpy.event_handler: rclpy.qos_events: QoSLivelinessChangedInfo UnsupportedEventTypeError
rclpy.event_handler: rclpy.qos_events: QoSPublisherMatchedInfo=QoSMatchedInfo
rclpy.event_handler: rclpy.qos_events: QoSSubscriptionMatchedInfo=QoSMatchedInfo
rclpy.event_handler: rclpy.qos_events: QoSOfferedIncompatibleQoSInfo=QoSIncompatibleInfo
rclpy.event_handler: rclpy.qos_events: QoSRequestedIncompatibleQoSInfo=QoSIncompatibleInfo
rclpy.event_handler: rclpy.qos_events: QoSOfferedDeadlineMissedInfo=QoSCountInfo
rclpy.event_handler: rclpy.qos_events: QoSRequestedDeadlineMissedInfo=QoSCountInfo
rclpy.event_handler: rclpy.qos_events: QoSLivelinessLostInfo=QoSCountInfo
rclpy.event_handler: rclpy.qos_events: QoSMessageLostInfo=QoSCountInfo
rclpy.qos_event: rclpy.qos_events: PublisherEventCallbacks SubscriptionEventCallbacks
rclpy.qos_overriding_options: rclpy.qos_overriding_options: QoSOverridingOptions
rclpy.qos_overriding_options: rclpy.qos_overriding_options: QosCallbackResult
rclpy.qos_overriding_options: rclpy.qos_overriding_options: InvalidQosOverridesError
rclpy.qos_overriding_options: rclpy.qos_overriding_options: _declare_qos_parameters
rclpy.qos_overriding_options: rclpy.qos_overriding_options: _get_qos_policy_parameter
rclpy.qos_overriding_options: rclpy.qos: QoSPolicyKind
rclpy.service_introspection: rclpy.services: ServiceIntrospectionState
rclpy.service: rclpy.services: ServiceIntrospectionState
rclpy.client: rclpy.services: ServiceIntrospectionState
rclpy.time_source: rclpy.time_source: TimeSource CLOCK_TOPIC USE_SIM_TIME_NAME
rclpy.type_support: rclpy.type_support: check_for_type_support check_is_valid_msg_type
rclpy.type_support: rclpy.type_support: check_is_valid_srv_type
rclpy.type_description_service: rclpy.services: START_TYPE_DESCRIPTION_SERVICE_PARAM
rclpy.type_hash: rclpy.endpoints: TypeHash
rclpy.topic_endpoint_info: rclpy.endpoints: TopicEndpointInfo TopicEndpointTypeEnum
rclpy.wait_for_message: rclpy.core: wait_for_message
rclpy.client: rclpy.services: Client
rclpy.service: rclpy.services: Service
rclpy.guard_condition: rclpy.entities: GuardCondition
rclpy.task: rclpy.futures: Future Task
rclpy.executors: rclpy.executors: Executor SingleThreadedExecutor MultiThreadedExecutor
rclpy.executors: rclpy.exceptions: ExternalShutdownException ShutdownException
rclpy.executors: rclpy.exceptions: TimeoutException ConditionReachedException
rclpy.callback_groups: rclpy.entities: CallbackGroup MutuallyExclusiveCallbackGroup
rclpy.callback_groups: rclpy.entities: ReentrantCallbackGroup
rclpy.logging: rclpy.logging: get_logger LoggingSeverity set_logger_level initialize shutdown
rclpy.logging: rclpy.logging: clear_config get_logging_directory _root_logger
rclpy.logging: rclpy.logging: get_logger_effective_level get_logging_severity_from_string
rclpy.impl.rcutils_logger: rclpy.logging: RcutilsLogger SkipFirst
rclpy.impl.logging_severity: rclpy.logging: LoggingSeverity
rclpy.parameter: rclpy.parameters: Parameter parameter_value_to_python get_parameter_value
rclpy.parameter: rclpy.parameters: parameter_dict_from_yaml_file PARAMETER_SEPARATOR_STRING
rclpy.parameter_client: rclpy.parameter_client: AsyncParameterClient
rclpy.parameter_event_handler: rclpy.parameter_events: ParameterEventHandler
rclpy.parameter_event_handler: rclpy.parameter_events: ParameterCallbackHandle
rclpy.parameter_event_handler: rclpy.parameter_events: ParameterEventCallbackHandle
rclpy.exceptions: rclpy.exceptions: NotInitializedException ROSInterruptException
rclpy.exceptions: rclpy.exceptions: NameValidationException InvalidHandle ParameterException
rclpy.exceptions: rclpy.exceptions: InvalidNamespaceException InvalidNodeNameException
rclpy.exceptions: rclpy.exceptions: InvalidTopicNameException InvalidServiceNameException
rclpy.exceptions: rclpy.exceptions: NoTypeSupportImportedException
rclpy.exceptions: rclpy.exceptions: ParameterNotDeclaredException
rclpy.exceptions: rclpy.exceptions: ParameterAlreadyDeclaredException
rclpy.exceptions: rclpy.exceptions: InvalidParameterException InvalidParameterTypeException
rclpy.exceptions: rclpy.exceptions: InvalidParameterValueException ParameterImmutableException
rclpy.exceptions: rclpy.exceptions: ParameterUninitializedException
rclpy.qos: rclpy.qos: QoSProfile HistoryPolicy ReliabilityPolicy DurabilityPolicy
rclpy.qos: rclpy.qos: LivelinessPolicy QoSHistoryPolicy QoSReliabilityPolicy
rclpy.qos: rclpy.qos: QoSDurabilityPolicy QoSLivelinessPolicy QoSPresetProfiles
rclpy.qos: rclpy.qos: InvalidQoSProfileException qos_profile_system_default
rclpy.qos: rclpy.qos: qos_profile_unknown qos_profile_best_available QoSPolicyKind
rclpy.qos: rclpy.qos: qos_profile_sensor_data qos_profile_services_default
rclpy.qos: rclpy.qos: qos_check_compatible QoSCompatibility
rclpy.qos: rclpy.qos: qos_profile_parameters qos_profile_parameter_events
rclpy.qos: rclpy.qos: qos_profile_rosout_default
rclpy.qos: rclpy.qos: qos_profile_action_status_default
rclpy.action: rclpy.action_client: ActionClient
rclpy.action: rclpy.action_server: ActionServer GoalResponse CancelResponse
rclpy.action: rclpy.node_graph: get_action_client_names_and_types_by_node
rclpy.action: rclpy.node_graph: get_action_server_names_and_types_by_node
rclpy.action: rclpy.node_graph: get_action_names_and_types
rclpy.action.graph: rclpy.node_graph: get_action_client_names_and_types_by_node
rclpy.action.graph: rclpy.node_graph: get_action_server_names_and_types_by_node
rclpy.action.graph: rclpy.node_graph: get_action_names_and_types
rclpy.action.client: rclpy.action_client: ActionClient ClientGoalHandle
rclpy.action.client: rclpy.action_client: GoalStatus
rclpy.action.server: rclpy.action_server: ActionServer ServerGoalHandle GoalResponse
rclpy.action.server: rclpy.action_server: CancelResponse
rclpy.lifecycle: rclpy.lifecycle: LifecycleNode LifecycleNodeMixin LifecyclePublisher
rclpy.lifecycle: rclpy.lifecycle: LifecycleState TransitionCallbackReturn ManagedEntity
rclpy.lifecycle: rclpy.lifecycle: SimpleManagedEntity Node=LifecycleNode State=LifecycleState
rclpy.lifecycle: rclpy.lifecycle: Publisher=LifecyclePublisher
rclpy.lifecycle.node: rclpy.lifecycle: LifecycleNode LifecycleNodeMixin LifecycleState
rclpy.lifecycle.node: rclpy.lifecycle: TransitionCallbackReturn
rclpy.lifecycle.publisher: rclpy.lifecycle: LifecyclePublisher
rclpy.lifecycle.managed_entity: rclpy.lifecycle: ManagedEntity SimpleManagedEntity
rclpy.serialization: rclpy.serialization: serialize_message deserialize_message
rclpy.signals: rclpy.core: SignalHandlerOptions get_current_signal_handlers_options
rclpy.utilities: rclpy.core: remove_ros_args ok get_default_context timeout_sec_to_nsec
rclpy.utilities: rclpy.core: get_rmw_implementation_identifier shutdown try_shutdown
rclpy.expand_topic_name: rclpy.validation: expand_topic_name
rclpy.topic_or_service_is_hidden: rclpy.validation: topic_or_service_is_hidden
rclpy.topic_or_service_is_hidden: rclpy.validation: HIDDEN_TOPIC_PREFIX
rclpy.validate_full_topic_name: rclpy.validation: validate_full_topic_name
rclpy.validate_namespace: rclpy.validation: validate_namespace
rclpy.validate_node_name: rclpy.validation: validate_node_name
rclpy.validate_parameter_name: rclpy.validation: validate_parameter_name
rclpy.validate_topic_name: rclpy.validation: validate_topic_name
message_filters: rclpy.message_filters: Subscriber Cache TimeSynchronizer SimpleFilter
message_filters: rclpy.message_filters: ApproximateTimeSynchronizer
tf2_py: tf2.core: BufferCore
tf2_py: .base.errors: TransformException LookupException ConnectivityException TimeoutException
tf2_py: .base.errors: ExtrapolationException InvalidArgumentException
tf2_ros: tf2.buffer: Buffer
tf2_ros: tf2.core: BufferCore
tf2_ros: tf2.interface: BufferInterface
tf2_ros: tf2.broadcasters: TransformListener TransformBroadcaster
tf2_ros: tf2.broadcasters: StaticTransformBroadcaster StaticTransformListener
tf2_ros: .base.errors: TransformException LookupException ConnectivityException TimeoutException
tf2_ros: .base.errors: ExtrapolationException InvalidArgumentException
tf2_ros: tf2.registry: TransformRegistration ConvertRegistration TypeException convert
tf2_ros: tf2.registry: NotImplementedException
tf2_ros: rclpy.time: Time Duration
tf2_ros: rclpy.node: Node
tf2_ros: rclpy.qos: QoSProfile HistoryPolicy DurabilityPolicy
tf2_ros: geometry_msgs/msg: TransformStamped
tf2_ros: tf2_msgs/msg: TFMessage
tf2_ros: tf2_msgs/srv: FrameGraph
tf2_ros.buffer: tf2.buffer: Buffer
tf2_ros.transform_broadcaster: geometry_msgs/msg: TransformStamped
tf2_ros.transform_broadcaster: tf2_msgs/msg: TFMessage
tf2_ros.static_transform_broadcaster: geometry_msgs/msg: TransformStamped
tf2_ros.static_transform_broadcaster: tf2_msgs/msg: TFMessage
tf2_ros.transform_listener: tf2_msgs/msg: TFMessage
tf2_ros.buffer_interface: tf2.interface: BufferInterface
tf2_ros.buffer_interface: tf2.registry: TransformRegistration ConvertRegistration TypeException
tf2_ros.buffer_interface: tf2.registry: convert NotImplementedException
tf2_ros.transform_listener: tf2.broadcasters: TransformListener DEFAULT_TF_TOPIC
tf2_ros.transform_listener: tf2.broadcasters: DEFAULT_STATIC_TF_TOPIC
tf2_ros.static_transform_listener: tf2.broadcasters: StaticTransformListener
tf2_ros.transform_broadcaster: tf2.broadcasters: TransformBroadcaster
tf2_ros.static_transform_broadcaster: tf2.broadcasters: StaticTransformBroadcaster
tf2_geometry_msgs: tf2.do_transform: do_transform_point do_transform_vector3 do_transform_pose
tf2_geometry_msgs: tf2.do_transform: do_transform_pose_stamped do_transform_wrench
tf2_geometry_msgs: tf2.do_transform: do_transform_wrench_stamped do_transform_polygon_stamped
tf2_geometry_msgs: tf2.do_transform: do_transform_pose_with_covariance_stamped
tf2_geometry_msgs: tf2.do_transform: transform_covariance to_msg_msg from_msg_msg
tf2_geometry_msgs.tf2_geometry_msgs: tf2.do_transform: *
tf2_ros: tf2.remote: BufferClient BufferServer
tf2_ros.buffer_client: tf2.remote: BufferClient
tf2_ros.buffer_server: tf2.remote: BufferServer
tf2_sensor_msgs: tf2.do_transform: do_transform_cloud transform_points
tf2_sensor_msgs.tf2_sensor_msgs: tf2.do_transform: do_transform_cloud transform_points
sensor_msgs_py.point_cloud2: tf2.point_clouds: read_points read_points_numpy read_points_list
sensor_msgs_py.point_cloud2: tf2.point_clouds: create_cloud create_cloud_xyz32 dtype_from_fields
sensor_msgs_py.point_cloud2: tf2.point_clouds: DUMMY_FIELD_PREFIX
tf_transformations: tf2.euler: quaternion_from_euler euler_from_quaternion euler_from_matrix
tf_transformations: tf2.euler: euler_matrix quaternion_matrix quaternion_from_matrix
tf_transformations: tf2.euler: quaternion_about_axis quaternion_multiply quaternion_inverse
tf_transformations: tf2.euler: quaternion_conjugate quaternion_slerp identity_matrix
tf_transformations: tf2.euler: translation_matrix translation_from_matrix inverse_matrix
tf_transformations: tf2.euler: concatenate_matrices compose_matrix vector_norm unit_vector
tf_transformations: tf2.euler: TRANSLATION_IDENTITY ROTATION_IDENTITY
launch: launch.description: LaunchDescription LaunchDescriptionSource
launch: launch.context: LaunchContext
launch: launch.action: Action
launch: launch.service: LaunchService
launch.launch_service: launch.service: LaunchService
launch.logging: launch.logging: get_logger launch_config LaunchConfig reset
launch.logging.handlers: launch.logging: Handler StreamHandler FileHandler
launch: launch.conditions: Condition
launch: launch.events: Event EventHandler
launch: launch.substitutions: Substitution SomeSubstitutionsType
launch: launch.description: LaunchDescriptionEntity LaunchDescriptionSource
launch.action: launch.action: Action
launch.actions: launch.settings: DeclareLaunchArgument SetLaunchConfiguration
launch.actions: launch.settings: UnsetLaunchConfiguration ResetLaunchConfigurations
launch.actions: launch.settings: SetEnvironmentVariable AppendEnvironmentVariable
launch.actions: launch.settings: PushEnvironment PopEnvironment ResetEnvironment
launch.actions: launch.settings: UnsetEnvironmentVariable PushLaunchConfigurations=Push
launch.actions: launch.settings: PopLaunchConfigurations=Pop
launch.actions: launch.composition: OpaqueFunction GroupAction IncludeLaunchDescription
launch.actions: launch.composition: TimerAction
launch.actions: launch.reactions: LogInfo RegisterEventHandler UnregisterEventHandler EmitEvent
launch.actions: launch.reactions: Shutdown
launch.actions: launch.processes: ExecuteProcess ExecuteLocal=ExecuteProcess
launch.conditions: launch.conditions: IfCondition UnlessCondition LaunchConfigurationEquals
launch.conditions: launch.conditions: LaunchConfigurationNotEquals
launch.conditions: launch.conditions: InvalidConditionExpressionError evaluate_condition_expression
launch.event_handlers: launch.events: OnProcessExit OnProcessStart OnShutdown
launch.event_handlers: launch.events: OnExecutionComplete OnProcessIO
launch.events: launch.events: Shutdown ExecutionComplete matches_action
launch.events.process: launch.events: ProcessExited ProcessStarted ProcessIO
launch.events.process: launch.events: ShutdownProcess SignalProcess RunningProcessEvent
launch.event: launch.events: Event
launch.event_handler: launch.events: EventHandler
launch.condition: launch.conditions: Condition
launch.launch_description_entity: launch.description: LaunchDescriptionEntity
launch.frontend: launch.exposing: Entity Parser expose_action expose_substitution
launch.frontend.entity: launch.exposing: Entity
launch.frontend.parser: launch.exposing: Parser
launch.frontend.expose: launch.exposing: expose_action expose_substitution
launch.frontend.parse_substitution: launch.exposing: parse_substitution parse_if_substitutions
launch.launch_context: launch.context: LaunchContext
launch.launch_description: launch.description: LaunchDescription LaunchDescriptionEntity
launch.launch_description: launch.action: Action
launch.launch_description: launch.context: LaunchContext
launch.launch_description: launch.settings: DeclareLaunchArgument
launch.launch_description_source: launch.description: LaunchDescriptionSource
launch.launch_description_sources: launch.description: PythonLaunchDescriptionSource
launch.launch_description_sources: launch.description: AnyLaunchDescriptionSource
launch.launch_description_sources: launch.description: FrontendLaunchDescriptionSource
launch.some_substitutions_type: launch.substitutions: SomeSubstitutionsType
launch.substitution: launch.substitutions: Substitution
launch.substitutions: launch.substitutions: TextSubstitution LaunchConfiguration
launch.substitutions: launch.substitutions: EnvironmentVariable PathJoinSubstitution
launch.substitutions: launch.substitutions: StringJoinSubstitution PythonExpression
launch.substitutions: launch.substitutions: ThisLaunchFile ThisLaunchFileDir AnonName
launch.substitutions: launch.substitutions: FindExecutable Command SubstitutionFailure
launch.substitutions: launch.substitutions: LocalSubstitution FileContent
launch.substitutions: launch.logic: EqualsSubstitution NotEqualsSubstitution AndSubstitution
launch.substitutions: launch.logic: OrSubstitution NotSubstitution AnySubstitution
launch.substitutions: launch.logic: AllSubstitution IfElseSubstitution
launch.utilities: launch.utilities: perform_substitutions normalize_to_list_of_substitutions
launch.utilities: launch.utilities: ensure_argument_type is_a is_a_subclass isclassinstance
launch.utilities: launch.utilities: normalize_to_list_of_entities
launch.utilities.class_tools_impl: launch.utilities: is_a is_a_subclass isclassinstance
launch.utilities.ensure_argument_type_impl: launch.utilities: ensure_argument_type
launch_xml.launch_description_sources: launch.description: XMLLaunchDescriptionSource
launch_yaml.launch_description_sources: launch.description: YAMLLaunchDescriptionSource
launch_ros.actions: launch.nodes: Node
launch_ros.actions: launch.scope: PushRosNamespace PushROSNamespace=PushRosNamespace SetRemap
launch_ros.actions: launch.scope: SetParameter SetUseSimTime SetParametersFromFile
launch_ros.actions: launch.settings: SetROSLogDir=SetLogFolder
launch_ros.actions: launch.components: ComposableNodeContainer LoadComposableNodes
launch_ros.actions.load_composable_nodes: launch.components: get_composable_node_load_request
launch_ros.descriptions: launch.components: ComposableNode
launch_ros.descriptions.composable_node: launch.components: ComposableNode
launch_ros.actions: launch.composition: RosTimer=TimerAction ROSTimer=TimerAction
launch_ros.actions: launch.lifecycle: LifecycleNode LifecycleTransition
launch_ros.events: launch.lifecycle: matches_node_name
launch_ros.events.lifecycle: launch.lifecycle: ChangeState StateTransition
launch_ros.events.matchers: launch.lifecycle: matches_node_name
launch_ros.event_handlers: launch.lifecycle: OnStateTransition
launch.substitutions: launch.substitutions: LaunchLogDir
launch_ros.substitutions: launch.substitutions: ExecutableInPackage
launch_ros.substitutions: launch.substitutions: FindPackageShare FindPackagePrefix FindPackage
launch_ros.substitutions.find_package: launch.substitutions: FindPackageShare FindPackagePrefix
launch_ros.substitutions: launch.scope: Parameter=ParameterSubstitution
launch_ros.substitutions.parameter: launch.scope: Parameter=ParameterSubstitution
launch_ros.parameter_descriptions: launch.parameters: ParameterValue ParameterFile
launch_ros.parameter_descriptions: launch.parameters: Parameter=ParameterDescription
launch_ros.descriptions: launch.parameters: ParameterValue ParameterFile
launch_ros.descriptions: launch.parameters: Parameter=ParameterDescription
launch_ros.utilities: launch.scope: is_namespace_absolute is_root_namespace
launch_ros.utilities: launch.scope: make_namespace_absolute prefix_namespace
launch_ros.utilities: launch.scope: normalize_remap_rule normalize_remap_rules
launch_ros.utilities: launch.scope: add_node_name get_node_name_count
launch_ros.utilities: launch.parameters: normalize_parameters normalize_parameter_dict
launch_ros.utilities: launch.parameters: evaluate_parameters evaluate_parameter_dict
launch_testing: launch_testing.description: parametrize post_shutdown_test ReadyAggregator
launch_testing: launch_testing.description: ready_to_test_action_timeout
launch_testing: launch_testing.records: ActiveIoHandler IoHandler ActiveProcInfoHandler
launch_testing: launch_testing.records: ProcInfoHandler
launch_testing.actions: launch_testing.description: ReadyToTest Test GTest PyTest
launch_testing.asserts: launch_testing.records: assertExitCodes assertInStream assertInStdout
launch_testing.asserts: launch_testing.records: assertInStderr assertDefaultStream NO_CMD_ARGS
launch_testing.asserts: launch_testing.records: assertSequentialStdout SequentialTextChecker
launch_testing.asserts: launch_testing.records: EXIT_OK EXIT_SIGINT EXIT_SIGQUIT EXIT_SIGKILL
launch_testing.asserts: launch_testing.records: EXIT_SIGSEGV
launch_testing.decorator: launch_testing.description: post_shutdown_test
launch_testing.event_handlers: launch_testing.description: StdoutReadyListener
launch_testing.io_handler: launch_testing.records: ActiveIoHandler IoHandler
launch_testing.loader: launch_testing.runner: LoadTestsFromPythonModule TestRun
launch_testing.markers: launch_testing.description: keep_alive retry_on_failure
launch_testing.parse_arguments: launch_testing.runner: parse_launch_arguments
launch_testing.proc_info_handler: launch_testing.records: ActiveProcInfoHandler ProcInfoHandler
launch_testing.ready_aggregator: launch_testing.description: ReadyAggregator
launch_testing.test_result: launch_testing.runner: TestResult
launch_testing.test_runner: launch_testing.runner: LaunchTestRunner
launch_testing.tools: launch_testing.records: ProcessProxy launch_process
launch_testing.tools: launch_testing.text: basic_output_filter expect_output
launch_testing.tools: launch_testing.text: expected_output_from_file
launch_testing.tools.output: launch_testing.text: basic_output_filter expect_output
launch_testing.tools.output: launch_testing.text: expected_output_from_file
launch_testing.tools.output: launch_testing.text: get_default_filtered_prefixes
launch_testing.tools.output: launch_testing.text: get_default_filtered_patterns
launch_testing.tools.process: launch_testing.records: ProcessProxy launch_process
launch_testing.tools.text: launch_testing.text: build_line_match build_text_match
launch_testing.util: launch_testing.description: KeepAliveProc
launch_testing.util: launch_testing.records: resolveProcesses NoMatchingProcessException NO_CMD_ARGS
launch_testing_ros: launch_testing.topics: WaitForTopics MessagePump DataRepublisher
launch_testing_ros: launch_testing.runner: LaunchTestRunner
launch_testing_ros.data_republisher: launch_testing.topics: DataRepublisher
launch_testing_ros.message_pump: launch_testing.topics: MessagePump
launch_testing_ros.test_runner: launch_testing.runner: LaunchTestRunner
launch_testing_ros.tools: launch_testing.text: basic_output_filter
launch_testing_ros.tools.output: launch_testing.text: basic_output_filter
launch_testing_ros.wait_for_topics: launch_testing.topics: WaitForTopics
launch_pytest: launch_testing.fixtures: fixture
launch_pytest.actions: launch_testing.description: ReadyToTest
launch_pytest.tools: launch_testing.processes: *
launch_pytest.tools.process: launch_testing.processes: *
rosidl_runtime_py: rosidl_runtime: message_to_csv message_to_ordereddict message_to_yaml
rosidl_runtime_py: rosidl_runtime: set_message_fields
rosidl_runtime_py.convert: rosidl_runtime: message_to_csv message_to_ordereddict message_to_yaml
rosidl_runtime_py.convert: rosidl_runtime: get_message_slot_types
rosidl_runtime_py.set_message: rosidl_runtime: set_message_fields
rosidl_runtime_py.utilities: rosidl_runtime: get_action get_interface get_message get_service
ament_index_python: launch.packages: get_resource get_resources has_resource
ament_index_python.resources: launch.packages: get_resource get_resources has_resource
ament_index_python: launch.packages: get_package_share_directory get_package_prefix
ament_index_python: launch.packages: get_package_share_path PackageNotFoundError
ament_index_python: launch.packages: get_packages_with_prefixes
ament_index_python.packages: launch.packages: get_package_share_directory
ament_index_python.packages: launch.packages: get_package_prefix get_package_share_path
ament_index_python.packages: launch.packages: PackageNotFoundError get_packages_with_prefixes
"""


_WITH_MODULES_OF_CLASSES = (
    "launch.actions",
    "launch.conditions",
    "launch.event_handlers",
    "launch.events",
    "launch.events.process",
    "launch.launch_description_sources",
    "launch.substitutions",
    "launch_ros.actions",
    "launch_ros.event_handlers",
    "launch_ros.substitutions",
)

WHOLE_PACKAGES = (
    "rclpy", "launch", "launch_ros", "tf2_ros", "message_filters",
    "launch_testing", "launch_testing_ros", "launch_pytest",
)  # fmt: skip
"""Packages whose modules are there after no more than `import launch`."""


def snake_case(name: str) -> str:
    """Return the module in which ROS 2 defines a class: "execute_process" for ExecuteProcess."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


@dataclass(frozen=True, slots=True)
class ImportedName:
    """One name of a ROS 2 module.

    Attributes:
        module: Our module, below `tftool.ros`; or "package/kind" of an interface.
        name: Its name there; "*" means every public name.
    """

    module: str
    name: str


@cache
def table() -> Mapping[str, Mapping[str, ImportedName]]:
    """Return every provided module with its names; empty parent modules are included."""
    found: dict[str, dict[str, ImportedName]] = {}
    for line in _TABLE.strip().splitlines():
        theirs, ours, names = (part.strip() for part in line.split(":", 2))
        for name in names.split():
            shown, _, real = name.partition("=")
            found.setdefault(theirs, {})[shown] = ImportedName(ours, real or shown)
    for module in _WITH_MODULES_OF_CLASSES:
        for name, imported in list(found[module].items()):
            if name[0].isupper():
                found.setdefault(f"{module}.{snake_case(name)}", {})[name] = imported
    for module in list(found):
        parent = module.rpartition(".")[0]
        while parent:
            found.setdefault(parent, {})
            parent = parent.rpartition(".")[0]
    return found
