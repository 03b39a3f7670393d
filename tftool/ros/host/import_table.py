"""Table of the ROS 2 modules and names that tftool provides, with the implementing modules.

An entry has the form "ROS modules: tftool's module: names". A name that differs between ROS and
tftool is written `rosname=ourname`; "*" means all public names of the module. Angle brackets
after a name contain tags of launch files: the tags of an action in XML and YAML, or the tag of a
substitution `$(tag …)`.

tftool's module is a path below `tftool.ros`, such as `rclpy.node`. A path with a leading dot is
below `tftool`. A path with a slash, such as `std_srvs/srv`, is a package of interfaces and a kind
of interface.

As in ROS 2, each class of some modules can also be imported from a module with the class's name,
such as `launch.actions.execute_process`. Packages of interfaces, such as geometry_msgs, need no
entry: their modules are derived from the interface definitions.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

_TABLE = """
rclpy: rclpy.context: init InitContextManager Context List Optional TYPE_CHECKING
rclpy: rclpy.executors: spin spin_once spin_until_future_complete get_global_executor
rclpy: rclpy.node: create_node
rclpy rclpy.utilities: rclpy.context: shutdown try_shutdown ok get_default_context
    get_rmw_implementation_identifier
rclpy rclpy.node rclpy.parameter: rclpy.parameter: Parameter
rclpy rclpy.signals: rclpy.context: SignalHandlerOptions
rclpy.node tf2_ros: rclpy.node: Node
rclpy.node: rclpy.node_graph: NodeNameNonExistentError
rclpy.context: rclpy.context: Context
rclpy.time rclpy.clock tf2_ros: rclpy.time: Time
rclpy.time rclpy.duration rclpy.clock tf2_ros: rclpy.time: Duration
rclpy.time rclpy.clock rclpy.clock_type: rclpy.time: ClockType
rclpy.time rclpy.duration: rclpy.time: CONVERSION_CONSTANT=S_TO_NS
rclpy.time rclpy.duration rclpy.constants: rclpy.time: S_TO_NS
rclpy.duration: rclpy.time: Infinite
rclpy.clock: rclpy.time: Clock ROSClock ClockChange JumpHandle JumpThreshold TimeJump
rclpy.timer: rclpy.time: Rate
rclpy.timer: rclpy.entities: Timer TimerInfo
rclpy.publisher: rclpy.topics: Publisher
rclpy.subscription: rclpy.topics: Subscription MessageInfo
rclpy.event_handler rclpy.qos_event: rclpy.qos_events: PublisherEventCallbacks
    SubscriptionEventCallbacks
rclpy.event_handler: rclpy.qos_events: QoSPublisherEventType QoSSubscriptionEventType
    QoSLivelinessChangedInfo UnsupportedEventTypeError QoSPublisherMatchedInfo=QoSMatchedInfo
    QoSSubscriptionMatchedInfo=QoSMatchedInfo QoSOfferedIncompatibleQoSInfo=QoSIncompatibleInfo
    QoSRequestedIncompatibleQoSInfo=QoSIncompatibleInfo QoSOfferedDeadlineMissedInfo=QoSCountInfo
    QoSRequestedDeadlineMissedInfo=QoSCountInfo QoSLivelinessLostInfo=QoSCountInfo
    QoSMessageLostInfo=QoSCountInfo
rclpy.qos_overriding_options: rclpy.qos: QoSOverridingOptions QosCallbackResult
    InvalidQosOverridesError _declare_qos_parameters=declare_qos_parameters
    _get_qos_policy_parameter=qos_policy_parameter
rclpy.qos_overriding_options rclpy.qos: rclpy.qos: QoSPolicyKind
rclpy.service_introspection rclpy.service rclpy.client: rclpy.services: ServiceIntrospectionState
rclpy.time_source: rclpy.time_source: TimeSource CLOCK_TOPIC USE_SIM_TIME_NAME
rclpy.type_support: rclpy.node: check_for_type_support check_is_valid_msg_type
    check_is_valid_srv_type
rclpy.type_description_service: rclpy.services: START_TYPE_DESCRIPTION_SERVICE_PARAM
rclpy.type_hash: rclpy.node_graph: TypeHash
rclpy.topic_endpoint_info: rclpy.node_graph: TopicEndpointInfo TopicEndpointTypeEnum
rclpy.wait_for_message: rclpy.executors: wait_for_message
rclpy.client: rclpy.services: Client
rclpy.service: rclpy.services: Service
rclpy.guard_condition: rclpy.entities: GuardCondition
rclpy rclpy.task: rclpy.futures: Future
rclpy.task: rclpy.futures: Task
rclpy.executors: rclpy.executors: Executor SingleThreadedExecutor MultiThreadedExecutor
    ExternalShutdownException ShutdownException TimeoutException ConditionReachedException
rclpy.callback_groups: rclpy.entities: CallbackGroup MutuallyExclusiveCallbackGroup
    ReentrantCallbackGroup
rclpy.logging: rclpy.logging: get_logger set_logger_level initialize shutdown clear_config
    get_logging_directory _root_logger get_logger_effective_level get_logging_severity_from_string
rclpy.logging rclpy.impl.logging_severity: rclpy.logging: LoggingSeverity
rclpy.impl.rcutils_logger: rclpy.logging: RcutilsLogger SkipFirst
rclpy.parameter: rclpy.parameter: parameter_value_to_python get_parameter_value
    parameter_dict_from_yaml_file PARAMETER_SEPARATOR_STRING
rclpy.parameter_client: rclpy.parameter_client: AsyncParameterClient
rclpy.parameter_event_handler: rclpy.parameter_client: ParameterEventHandler ParameterCallbackHandle
    ParameterEventCallbackHandle
rclpy.exceptions: rclpy.exceptions: *
rclpy.qos tf2_ros: rclpy.qos: QoSProfile HistoryPolicy DurabilityPolicy
rclpy.qos: rclpy.qos: ReliabilityPolicy LivelinessPolicy QoSHistoryPolicy QoSReliabilityPolicy
    QoSDurabilityPolicy QoSLivelinessPolicy QoSPresetProfiles InvalidQoSProfileException
    qos_profile_system_default qos_profile_unknown qos_profile_best_available
    qos_profile_sensor_data qos_profile_services_default qos_check_compatible QoSCompatibility
    qos_profile_parameters qos_profile_parameter_events qos_profile_rosout_default
    qos_profile_action_status_default
rclpy.action rclpy.action.client: rclpy.action_client: ActionClient
rclpy.action rclpy.action.server: rclpy.action_server: ActionServer GoalResponse CancelResponse
rclpy.action rclpy.action.graph: rclpy.node_graph: get_action_client_names_and_types_by_node
    get_action_server_names_and_types_by_node get_action_names_and_types
rclpy.action.client: rclpy.action_client: ClientGoalHandle GoalStatus
rclpy.action.server: rclpy.action_server: ServerGoalHandle
rclpy.lifecycle rclpy.lifecycle.node: rclpy.lifecycle: LifecycleNode LifecycleNodeMixin
    LifecycleState
rclpy.lifecycle rclpy.lifecycle.node rclpy.lifecycle.managed_entity: rclpy.lifecycle:
    TransitionCallbackReturn
rclpy.lifecycle rclpy.lifecycle.publisher: rclpy.lifecycle: LifecyclePublisher
rclpy.lifecycle rclpy.lifecycle.managed_entity: rclpy.lifecycle: ManagedEntity SimpleManagedEntity
rclpy.lifecycle: rclpy.lifecycle: Node=LifecycleNode State=LifecycleState
    Publisher=LifecyclePublisher NodeMixin=LifecycleNodeMixin
rclpy.serialization: rclpy.topics: serialize_message deserialize_message
rclpy.signals: rclpy.context: get_current_signal_handlers_options
rclpy.utilities: rclpy.context: remove_ros_args timeout_sec_to_nsec
rclpy.expand_topic_name: rclpy.validation: expand_topic_name
rclpy.topic_or_service_is_hidden: rclpy.validation: topic_or_service_is_hidden HIDDEN_TOPIC_PREFIX
rclpy.validate_full_topic_name: rclpy.validation: validate_full_topic_name
rclpy.validate_namespace: rclpy.validation: validate_namespace
rclpy.validate_node_name: rclpy.validation: validate_node_name
rclpy.validate_parameter_name: rclpy.validation: validate_parameter_name
rclpy.validate_topic_name: rclpy.validation: validate_topic_name
message_filters: rclpy.message_filters: *
tf2_py tf2_ros: tf2.buffer: BufferCore
tf2_py tf2_ros: .base.errors: TransformException LookupException ConnectivityException
    TimeoutException ExtrapolationException InvalidArgumentException
tf2_ros tf2_ros.buffer: tf2.buffer: Buffer
tf2_ros tf2_ros.buffer_interface: tf2.buffer: BufferInterface TransformRegistration
    ConvertRegistration TypeException convert NotImplementedException
tf2_ros tf2_ros.transform_listener: tf2.broadcasters: TransformListener
tf2_ros tf2_ros.transform_broadcaster: tf2.broadcasters: TransformBroadcaster
tf2_ros tf2_ros.static_transform_broadcaster: tf2.broadcasters: StaticTransformBroadcaster
tf2_ros tf2_ros.static_transform_listener: tf2.broadcasters: StaticTransformListener
tf2_ros tf2_ros.transform_broadcaster tf2_ros.static_transform_broadcaster: geometry_msgs/msg:
    TransformStamped
tf2_ros tf2_ros.transform_broadcaster tf2_ros.static_transform_broadcaster
    tf2_ros.transform_listener: tf2_msgs/msg: TFMessage
tf2_ros: tf2_msgs/srv: FrameGraph
tf2_ros.transform_listener: tf2.broadcasters: DEFAULT_TF_TOPIC DEFAULT_STATIC_TF_TOPIC
tf2_geometry_msgs tf2_geometry_msgs.tf2_geometry_msgs: tf2.do_transform: do_transform_point
    do_transform_vector3 do_transform_pose do_transform_pose_stamped do_transform_wrench
    do_transform_wrench_stamped do_transform_polygon_stamped
    do_transform_pose_with_covariance_stamped transform_covariance to_msg_msg from_msg_msg
tf2_ros tf2_ros.buffer_client: tf2.remote: BufferClient
tf2_ros tf2_ros.buffer_server: tf2.remote: BufferServer
tf2_sensor_msgs tf2_sensor_msgs.tf2_sensor_msgs: tf2.do_transform: do_transform_cloud
    transform_points
sensor_msgs_py.point_cloud2: tf2.point_clouds: *
tf_transformations: tf2.euler: *
launch launch.launch_description: launch.description: LaunchDescription
launch launch.launch_description_source: launch.description: LaunchDescriptionSource
launch launch.launch_context launch.launch_description: launch.context: LaunchContext
launch launch.action launch.launch_description: launch.description: Action
launch launch.launch_service: launch.service: LaunchService
launch.logging: launch.logging: get_logger launch_config LaunchConfig reset
launch.logging.handlers: launch.logging: Handler StreamHandler FileHandler
launch launch.condition: launch.conditions: Condition
launch launch.event: launch.events: Event
launch launch.event_handler: launch.events: EventHandler
launch launch.substitution: launch.substitutions: Substitution
launch launch.some_substitutions_type: launch.substitutions: SomeSubstitutionsType
launch launch.launch_description_entity launch.launch_description: launch.description:
    LaunchDescriptionEntity
launch.actions launch.launch_description: launch.actions: DeclareLaunchArgument<arg>
launch.actions: launch.actions: SetLaunchConfiguration<let> UnsetLaunchConfiguration
    ResetLaunchConfigurations<reset> SetEnvironmentVariable<set_env>
    AppendEnvironmentVariable<append_env> PushEnvironment<push_env> PopEnvironment<pop_env>
    ResetEnvironment<reset_env> UnsetEnvironmentVariable<unset_env> PushLaunchConfigurations=Push
    PopLaunchConfigurations=Pop OpaqueFunction GroupAction<group> IncludeLaunchDescription<include>
    TimerAction<timer> LogInfo<log> RegisterEventHandler UnregisterEventHandler EmitEvent
launch.actions launch.actions.shutdown_action: launch.actions: Shutdown<shutdown>
launch.actions: launch.processes: ExecuteProcess<executable> ExecuteLocal=ExecuteProcess
launch.conditions: launch.conditions: IfCondition UnlessCondition LaunchConfigurationEquals
    LaunchConfigurationNotEquals InvalidConditionExpressionError evaluate_condition_expression
launch.event_handlers: launch.events: OnProcessExit OnProcessStart OnShutdown OnExecutionComplete
    OnProcessIO
launch.events: launch.events: Shutdown ExecutionComplete
launch.events launch.events.matchers: launch.events: matches_action
launch.events.process: launch.events: ProcessExited ProcessStarted ProcessIO ShutdownProcess
    SignalProcess RunningProcessEvent
launch.frontend launch.frontend.parser: launch.frontend: Parser
launch.frontend launch.frontend.expose: launch.parsing: expose_substitution
launch.frontend.parse_substitution: launch.parsing: parse_substitution parse_if_substitutions
launch.launch_description_sources: launch.description: PythonLaunchDescriptionSource
    AnyLaunchDescriptionSource FrontendLaunchDescriptionSource
launch.substitutions: launch.substitutions: TextSubstitution LaunchConfiguration<$var>
    EnvironmentVariable<$env> PathJoinSubstitution PathSubstitution StringJoinSubstitution
    PythonExpression<$eval>
    ThisLaunchFile<$filename> ThisLaunchFileDir<$dirname> AnonName<$anon> FindExecutable<$find-exec>
    Command<$command> SubstitutionFailure LocalSubstitution FileContent<$file-content>
    LaunchLogDir<$log_dir,$launch_log_dir>
launch.substitutions: launch.logic: EqualsSubstitution<$equals> NotEqualsSubstitution<$not-equals>
    IfElseSubstitution<$if>
launch.substitutions launch.substitutions.boolean_substitution: launch.logic: AndSubstitution<$and>
    OrSubstitution<$or> NotSubstitution<$not> AnySubstitution<$any> AllSubstitution<$all>
launch.utilities launch.utilities.perform_substitutions_impl: launch.substitutions:
    perform_substitutions
launch.utilities launch.utilities.normalize_to_list_of_substitutions_impl: launch.substitutions:
    normalize_to_list_of_substitutions
launch.utilities launch.utilities.normalize_to_list_of_entities_impl: launch.substitutions:
    normalize_to_list_of_entities
launch launch.some_entities_type: launch.description: SomeEntitiesType
launch.utilities launch.utilities.ensure_argument_type_impl: launch.substitutions:
    ensure_argument_type
launch.utilities launch.utilities.class_tools_impl: launch.substitutions: is_a is_a_subclass
    isclassinstance
launch_xml.launch_description_sources: launch.description: XMLLaunchDescriptionSource
launch_yaml.launch_description_sources: launch.description: YAMLLaunchDescriptionSource
launch_ros.actions: launch.nodes: Node<node>
launch_ros.actions: launch.scope: PushRosNamespace<push_ros_namespace>
    PushROSNamespace=PushRosNamespace SetRemap<set_remap> SetParameter<set_parameter>
    SetUseSimTime<set_use_sim_time> SetParametersFromFile<set_parameters_from_file>
launch_ros.actions: launch.actions: SetROSLogDir=SetLogFolder<set_ros_log_dir>
    RosTimer=TimerAction<ros_timer> ROSTimer=TimerAction
launch_ros.actions: launch.components: ComposableNodeContainer<node_container>
    LoadComposableNodes<load_composable_node>
launch_ros.actions.load_composable_nodes: launch.components: get_composable_node_load_request
launch_ros.descriptions launch_ros.descriptions.composable_node: launch.components: ComposableNode
launch_ros.actions: launch.lifecycle: LifecycleNode<lifecycle_node> LifecycleTransition
launch_ros.events launch_ros.events.matchers launch_ros.events.matchers.matches_node_name
    launch_ros.events.lifecycle launch_ros.events.lifecycle.lifecycle_node_matchers:
    launch.lifecycle: matches_node_name
launch_ros.events.lifecycle: launch.lifecycle: ChangeState StateTransition
launch_ros.event_handlers: launch.lifecycle: OnStateTransition
launch_ros.substitutions: launch.substitutions: ExecutableInPackage<$exec-in-pkg> FindPackage
launch_ros.substitutions launch_ros.substitutions.find_package: launch.substitutions:
    FindPackageShare<$find-pkg-share> FindPackagePrefix<$find-pkg-prefix>
launch_ros.substitutions launch_ros.substitutions.parameter: launch.scope:
    Parameter=ParameterSubstitution<$param>
launch_ros.parameter_descriptions launch_ros.descriptions: launch.parameters: ParameterValue
    ParameterFile Parameter=ParameterDescription
launch_ros.utilities launch_ros.utilities.namespace_utils: launch.scope: is_namespace_absolute
    is_root_namespace make_namespace_absolute prefix_namespace
launch_ros.utilities launch_ros.utilities.normalize_remap_rule: launch.scope: normalize_remap_rule
    normalize_remap_rules
launch_ros.utilities launch_ros.utilities.track_node_names: launch.scope: add_node_name
    get_node_name_count
launch_ros.utilities launch_ros.utilities.normalize_parameters: launch.parameters:
    normalize_parameters normalize_parameter_dict
launch_ros.utilities launch_ros.utilities.evaluate_parameters: launch.parameters:
    evaluate_parameters evaluate_parameter_dict
launch_testing: launch_testing.description: parametrize ready_to_test_action_timeout
launch_testing launch_testing.decorator: launch_testing.description: post_shutdown_test
launch_testing launch_testing.ready_aggregator: launch_testing.description: ReadyAggregator
launch_testing launch_testing.io_handler: launch_testing.records: ActiveIoHandler IoHandler
launch_testing launch_testing.proc_info_handler: launch_testing.records: ActiveProcInfoHandler
    ProcInfoHandler
launch_testing.actions launch_pytest.actions: launch_testing.description: ReadyToTest
launch_testing.actions: launch_testing.description: Test GTest PyTest
launch_testing.asserts: launch_testing.records: assertExitCodes assertInStream assertInStdout
    assertInStderr assertDefaultStream assertSequentialStdout SequentialTextChecker EXIT_OK
    EXIT_SIGINT EXIT_SIGQUIT EXIT_SIGKILL EXIT_SIGSEGV
launch_testing.asserts launch_testing.util: launch_testing.records: NO_CMD_ARGS
launch_testing.event_handlers: launch_testing.description: StdoutReadyListener
launch_testing.loader: launch_testing.runner: LoadTestsFromPythonModule TestRun
launch_testing.markers: launch_testing.description: keep_alive retry_on_failure
launch_testing.parse_arguments: launch_testing.runner: parse_launch_arguments
launch_testing.test_result: launch_testing.runner: TestResult
launch_testing.test_runner launch_testing_ros launch_testing_ros.test_runner: launch_testing.runner:
    LaunchTestRunner
launch_testing.tools launch_testing.tools.process: launch_testing.records: ProcessProxy
    launch_process
launch_testing.tools launch_testing.tools.output launch_testing_ros.tools
    launch_testing_ros.tools.output: launch_testing.text: basic_output_filter
launch_testing.tools launch_testing.tools.output: launch_testing.text: expect_output
    expected_output_from_file
launch_testing.tools.output: launch_testing.text: get_default_filtered_prefixes
    get_default_filtered_patterns
launch_testing.tools.text: launch_testing.text: build_line_match build_text_match
launch_testing.util: launch_testing.description: KeepAliveProc
launch_testing.util: launch_testing.records: resolveProcesses NoMatchingProcessException
launch_testing_ros launch_testing_ros.wait_for_topics: launch_testing.topics: WaitForTopics
launch_testing_ros launch_testing_ros.message_pump: launch_testing.topics: MessagePump
launch_testing_ros launch_testing_ros.data_republisher: launch_testing.topics: DataRepublisher
launch_pytest: launch_testing.fixtures: fixture
launch_pytest.tools launch_pytest.tools.process: launch_testing.processes: *
rosidl_runtime_py rosidl_runtime_py.convert: host.rosidl_runtime: message_to_csv
    message_to_ordereddict message_to_yaml
rosidl_runtime_py rosidl_runtime_py.set_message: host.rosidl_runtime: set_message_fields
rosidl_runtime_py.convert: host.rosidl_runtime: get_message_slot_types
rosidl_runtime_py.utilities: host.rosidl_runtime: get_action get_interface get_message get_service
ament_index_python ament_index_python.resources: launch.packages: get_resource get_resources
    has_resource
ament_index_python ament_index_python.packages: launch.packages: get_package_share_directory
    get_package_prefix get_package_share_path PackageNotFoundError get_packages_with_prefixes
"""


_IMPORTS = """
rclpy.action.client rclpy.action.server: rclpy.qos rclpy.task rclpy.type_support action_msgs.msg
    action_msgs.srv unique_identifier_msgs.msg
rclpy.client rclpy.service: rclpy.callback_groups rclpy.clock rclpy.context rclpy.qos rclpy.task
rclpy.clock rclpy.timer: rclpy.callback_groups rclpy.clock rclpy.clock_type rclpy.context
    rclpy.exceptions rclpy.time rclpy.utilities
rclpy.executors: rclpy.client rclpy.clock rclpy.clock_type rclpy.context rclpy.exceptions
    rclpy.guard_condition rclpy.service rclpy.subscription rclpy.task rclpy.timer rclpy.utilities
rclpy.guard_condition rclpy.signals: rclpy.callback_groups rclpy.context rclpy.exceptions
    rclpy.guard_condition rclpy.utilities
rclpy.lifecycle.node: rclpy.callback_groups rclpy.lifecycle.managed_entity
    rclpy.lifecycle.publisher rclpy.node rclpy.qos rclpy.service rclpy.type_support
rclpy.lifecycle.publisher: rclpy.callback_groups rclpy.event_handler
    rclpy.lifecycle.managed_entity rclpy.publisher rclpy.qos
rclpy.logging: rclpy.impl.rcutils_logger
rclpy.node: rclpy.callback_groups rclpy.client rclpy.clock rclpy.constants rclpy.context
    rclpy.event_handler rclpy.exceptions rclpy.executors rclpy.expand_topic_name
    rclpy.guard_condition rclpy.impl.rcutils_logger rclpy.logging rclpy.parameter rclpy.publisher
    rclpy.qos rclpy.qos_overriding_options rclpy.service rclpy.subscription rclpy.time_source
    rclpy.timer rclpy.topic_endpoint_info rclpy.type_support rclpy.utilities
    rclpy.validate_full_topic_name rclpy.validate_namespace rclpy.validate_node_name
    rclpy.validate_parameter_name rclpy.validate_topic_name rcl_interfaces.msg rcl_interfaces.srv
rclpy.parameter: rcl_interfaces.msg
rclpy.parameter_client rclpy.parameter_event_handler: rclpy.callback_groups rclpy.event_handler
    rclpy.node rclpy.parameter rclpy.qos rclpy.qos_overriding_options rclpy.subscription rclpy.task
    rcl_interfaces.msg rcl_interfaces.srv
rclpy.publisher rclpy.subscription rclpy.event_handler: rclpy.callback_groups rclpy.duration
    rclpy.event_handler rclpy.logging rclpy.qos
rclpy.qos: rclpy.duration
rclpy.qos_overriding_options: rclpy.duration rclpy.exceptions rclpy.parameter rclpy.publisher
    rclpy.qos rclpy.subscription rcl_interfaces.msg
rclpy.time_source: rclpy.clock rclpy.clock_type rclpy.parameter rclpy.qos rclpy.time
    rcl_interfaces.msg
rclpy.utilities: rclpy.constants rclpy.context
rclpy.wait_for_message: rclpy.node rclpy.qos rclpy.utilities
launch launch_ros: launch.action launch.condition launch.event launch.event_handler
    launch.frontend launch.frontend.expose launch.launch_context launch.launch_description
    launch.launch_description_entity launch.some_entities_type launch.some_substitutions_type
    launch.substitution launch.utilities
"""
"""Imports inside ROS 2: a module's entry lists the modules whose names it contains too.

An entry for launch or launch_ros means each module in the package.
"""

_WITH_MODULES_OF_CLASSES = (
    "launch.actions",
    "launch.conditions",
    "launch.event_handlers",
    "launch.events",
    "launch.events.process",
    "launch.launch_description_sources",
    "launch.substitutions",
    "launch_xml.launch_description_sources",
    "launch_yaml.launch_description_sources",
    "launch_ros.actions",
    "launch_ros.event_handlers",
    "launch_ros.events.lifecycle",
    "launch_ros.substitutions",
)

WHOLE_PACKAGES = (
    "rclpy", "launch", "launch_ros", "tf2_ros", "message_filters",
    "launch_testing", "launch_testing_ros", "launch_pytest", "launch.events", "launch_ros.events",
)  # fmt: skip
"""Packages whose submodules can be used after an import of the package alone."""

REGISTERING = ("tf2_geometry_msgs", "tf2_sensor_msgs")
"""Packages whose import alone makes buffers transform messages of further types."""


def snake_case(name: str) -> str:
    """Convert a class's name to snake case: "ExecuteProcess" becomes "execute_process"."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


@dataclass(frozen=True, slots=True)
class ImportedName:
    """Object in tftool that implements one name of a ROS 2 module.

    Attributes:
        module: Path of tftool's module below `tftool.ros`, or "package/kind" for an interface.
        name: Name in tftool's module; "*" for all public names of the module.
        tags: Tags in XML and YAML launch files; tags of substitutions begin with "$".
    """

    module: str
    name: str
    tags: Sequence[str] = ()


_ENTRY = re.compile(r"(?P<shown>\w+|\*)(?:=(?P<real>\w+))?(?:<(?P<tags>[^>]*)>)?")


@cache
def table() -> Mapping[str, Mapping[str, ImportedName]]:
    """Return a mapping from each ROS 2 module to the names that tftool provides in this module.

    A package that only contains other modules has no names.
    """
    found: dict[str, dict[str, ImportedName]] = {}
    for entry in re.split(r"\n(?! )", _TABLE.strip()):
        modules, ours, names = map(str.split, entry.split(":"))
        for theirs, name in product(modules, names):
            shown, real, tags = _ENTRY.fullmatch(name).groups()  # type: ignore[union-attr]
            made = ImportedName(ours[0], real or shown, tags.split(",") if tags else ())
            found.setdefault(theirs, {})[shown] = made
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


@cache
def _imports() -> Mapping[str, Sequence[str]]:
    entries = (entry.split(":") for entry in re.split(r"\n(?! )", _IMPORTS.strip()))
    return {module: found.split() for modules, found in entries for module in modules.split()}


def imported_by(module: str) -> Sequence[str]:
    """Return the ROS 2 modules from which the ROS 2 module `module` imports names."""
    if any(other.startswith(f"{module}.") for other in table()):
        return ()  # A package, such as launch.actions, shows only its own names.
    package = module.partition(".")[0]
    return _imports().get(module) or _imports().get(package, ())


@cache
def tagged() -> Mapping[str, ImportedName]:
    """Return a mapping from each tag of launch files, such as "node", to its `ImportedName`."""
    names = (one for names in table().values() for one in names.values())
    return {tag: one for one in names for tag in one.tags}
