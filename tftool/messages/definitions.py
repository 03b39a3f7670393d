"""Definitions of the ROS 2 interfaces that are included in tftool.

Each block is one interface: its full name, then its fields as in a .msg, .srv or .action file, with
`;` for a line break. `---` separates the parts of a service or an action. The module `classes`
creates classes from these definitions.
"""

from functools import cache
from typing import Final

_TEXT = """
builtin_interfaces/msg/Time = int32 sec; uint32 nanosec
builtin_interfaces/msg/Duration = int32 sec; uint32 nanosec

unique_identifier_msgs/msg/UUID = uint8[16] uuid

std_msgs/msg/Header = builtin_interfaces/Time stamp; string frame_id
std_msgs/msg/Bool = bool data
std_msgs/msg/Byte = byte data
std_msgs/msg/Char = char data
std_msgs/msg/ColorRGBA = float32 r; float32 g; float32 b; float32 a
std_msgs/msg/Empty =
std_msgs/msg/Float32 = float32 data
std_msgs/msg/Float64 = float64 data
std_msgs/msg/Int8 = int8 data
std_msgs/msg/Int16 = int16 data
std_msgs/msg/Int32 = int32 data
std_msgs/msg/Int64 = int64 data
std_msgs/msg/UInt8 = uint8 data
std_msgs/msg/UInt16 = uint16 data
std_msgs/msg/UInt32 = uint32 data
std_msgs/msg/UInt64 = uint64 data
std_msgs/msg/String = string data
std_msgs/msg/MultiArrayDimension = string label; uint32 size; uint32 stride
std_msgs/msg/MultiArrayLayout = MultiArrayDimension[] dim; uint32 data_offset
std_msgs/msg/Float32MultiArray = MultiArrayLayout layout; float32[] data
std_msgs/msg/Float64MultiArray = MultiArrayLayout layout; float64[] data
std_msgs/msg/Int32MultiArray = MultiArrayLayout layout; int32[] data
std_msgs/msg/Int64MultiArray = MultiArrayLayout layout; int64[] data
std_msgs/msg/Int8MultiArray = MultiArrayLayout layout; int8[] data
std_msgs/msg/Int16MultiArray = MultiArrayLayout layout; int16[] data
std_msgs/msg/UInt16MultiArray = MultiArrayLayout layout; uint16[] data
std_msgs/msg/UInt32MultiArray = MultiArrayLayout layout; uint32[] data
std_msgs/msg/UInt64MultiArray = MultiArrayLayout layout; uint64[] data
std_msgs/msg/UInt8MultiArray = MultiArrayLayout layout; uint8[] data
std_msgs/msg/ByteMultiArray = MultiArrayLayout layout; byte[] data

geometry_msgs/msg/Vector3 = float64 x; float64 y; float64 z
geometry_msgs/msg/Point = float64 x; float64 y; float64 z
geometry_msgs/msg/Point32 = float32 x; float32 y; float32 z
geometry_msgs/msg/Quaternion = float64 x 0; float64 y 0; float64 z 0; float64 w 1
geometry_msgs/msg/Pose = Point position; Quaternion orientation
geometry_msgs/msg/Pose2D = float64 x; float64 y; float64 theta
geometry_msgs/msg/Transform = Vector3 translation; Quaternion rotation
geometry_msgs/msg/Twist = Vector3 linear; Vector3 angular
geometry_msgs/msg/Accel = Vector3 linear; Vector3 angular
geometry_msgs/msg/Wrench = Vector3 force; Vector3 torque
geometry_msgs/msg/Inertia = float64 m; Vector3 com; float64 ixx; float64 ixy; float64 ixz; float64 iyy; float64 iyz; float64 izz
geometry_msgs/msg/Polygon = Point32[] points
geometry_msgs/msg/PoseArray = std_msgs/Header header; Pose[] poses
geometry_msgs/msg/PoseWithCovariance = Pose pose; float64[36] covariance
geometry_msgs/msg/TwistWithCovariance = Twist twist; float64[36] covariance
geometry_msgs/msg/AccelWithCovariance = Accel accel; float64[36] covariance
geometry_msgs/msg/Vector3Stamped = std_msgs/Header header; Vector3 vector
geometry_msgs/msg/PointStamped = std_msgs/Header header; Point point
geometry_msgs/msg/QuaternionStamped = std_msgs/Header header; Quaternion quaternion
geometry_msgs/msg/PoseStamped = std_msgs/Header header; Pose pose
geometry_msgs/msg/TwistStamped = std_msgs/Header header; Twist twist
geometry_msgs/msg/AccelStamped = std_msgs/Header header; Accel accel
geometry_msgs/msg/WrenchStamped = std_msgs/Header header; Wrench wrench
geometry_msgs/msg/InertiaStamped = std_msgs/Header header; Inertia inertia
geometry_msgs/msg/PolygonStamped = std_msgs/Header header; Polygon polygon
geometry_msgs/msg/PoseWithCovarianceStamped = std_msgs/Header header; PoseWithCovariance pose
geometry_msgs/msg/TwistWithCovarianceStamped = std_msgs/Header header; TwistWithCovariance twist
geometry_msgs/msg/AccelWithCovarianceStamped = std_msgs/Header header; AccelWithCovariance accel
geometry_msgs/msg/TransformStamped = std_msgs/Header header; string child_frame_id; Transform transform
geometry_msgs/msg/VelocityStamped = std_msgs/Header header; string body_frame_id; string reference_frame_id; Twist velocity
geometry_msgs/msg/PolygonInstance = Polygon polygon; int64 id
geometry_msgs/msg/PolygonInstanceStamped = std_msgs/Header header; PolygonInstance polygon

sensor_msgs/msg/PointField = uint8 INT8=1; uint8 UINT8=2; uint8 INT16=3; uint8 UINT16=4; uint8 INT32=5; uint8 UINT32=6; uint8 FLOAT32=7; uint8 FLOAT64=8; string name; uint32 offset; uint8 datatype; uint32 count
sensor_msgs/msg/PointCloud2 = std_msgs/Header header; uint32 height; uint32 width; PointField[] fields; bool is_bigendian; uint32 point_step; uint32 row_step; uint8[] data; bool is_dense
sensor_msgs/msg/LaserScan = std_msgs/Header header; float32 angle_min; float32 angle_max; float32 angle_increment; float32 time_increment; float32 scan_time; float32 range_min; float32 range_max; float32[] ranges; float32[] intensities
sensor_msgs/msg/JointState = std_msgs/Header header; string[] name; float64[] position; float64[] velocity; float64[] effort
sensor_msgs/msg/Imu = std_msgs/Header header; geometry_msgs/Quaternion orientation; float64[9] orientation_covariance; geometry_msgs/Vector3 angular_velocity; float64[9] angular_velocity_covariance; geometry_msgs/Vector3 linear_acceleration; float64[9] linear_acceleration_covariance
sensor_msgs/msg/Range = uint8 ULTRASOUND=0; uint8 INFRARED=1; std_msgs/Header header; uint8 radiation_type; float32 field_of_view; float32 min_range; float32 max_range; float32 range; float32 variance
sensor_msgs/msg/Image = std_msgs/Header header; uint32 height; uint32 width; string encoding; uint8 is_bigendian; uint32 step; uint8[] data
sensor_msgs/msg/CompressedImage = std_msgs/Header header; string format; uint8[] data
sensor_msgs/msg/RegionOfInterest = uint32 x_offset; uint32 y_offset; uint32 height; uint32 width; bool do_rectify
sensor_msgs/msg/CameraInfo = std_msgs/Header header; uint32 height; uint32 width; string distortion_model; float64[] d; float64[9] k; float64[9] r; float64[12] p; uint32 binning_x; uint32 binning_y; RegionOfInterest roi
sensor_msgs/msg/Temperature = std_msgs/Header header; float64 temperature; float64 variance
sensor_msgs/msg/MagneticField = std_msgs/Header header; geometry_msgs/Vector3 magnetic_field; float64[9] magnetic_field_covariance
sensor_msgs/msg/Joy = std_msgs/Header header; float32[] axes; int32[] buttons
sensor_msgs/msg/BatteryState = uint8 POWER_SUPPLY_STATUS_UNKNOWN=0; uint8 POWER_SUPPLY_STATUS_CHARGING=1; uint8 POWER_SUPPLY_STATUS_DISCHARGING=2; uint8 POWER_SUPPLY_STATUS_NOT_CHARGING=3; uint8 POWER_SUPPLY_STATUS_FULL=4; uint8 POWER_SUPPLY_HEALTH_UNKNOWN=0; uint8 POWER_SUPPLY_HEALTH_GOOD=1; uint8 POWER_SUPPLY_HEALTH_OVERHEAT=2; uint8 POWER_SUPPLY_HEALTH_DEAD=3; uint8 POWER_SUPPLY_HEALTH_OVERVOLTAGE=4; uint8 POWER_SUPPLY_HEALTH_UNSPEC_FAILURE=5; uint8 POWER_SUPPLY_HEALTH_COLD=6; uint8 POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE=7; uint8 POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE=8; uint8 POWER_SUPPLY_TECHNOLOGY_UNKNOWN=0; uint8 POWER_SUPPLY_TECHNOLOGY_NIMH=1; uint8 POWER_SUPPLY_TECHNOLOGY_LION=2; uint8 POWER_SUPPLY_TECHNOLOGY_LIPO=3; uint8 POWER_SUPPLY_TECHNOLOGY_LIFE=4; uint8 POWER_SUPPLY_TECHNOLOGY_NICD=5; uint8 POWER_SUPPLY_TECHNOLOGY_LIMN=6; uint8 POWER_SUPPLY_TECHNOLOGY_TERNARY=7; uint8 POWER_SUPPLY_TECHNOLOGY_VRLA=8; std_msgs/Header header; float32 voltage; float32 temperature; float32 current; float32 charge; float32 capacity; float32 design_capacity; float32 percentage; uint8 power_supply_status; uint8 power_supply_health; uint8 power_supply_technology; bool present; float32[] cell_voltage; float32[] cell_temperature; string location; string serial_number
sensor_msgs/msg/ChannelFloat32 = string name; float32[] values
sensor_msgs/msg/FluidPressure = std_msgs/Header header; float64 fluid_pressure; float64 variance
sensor_msgs/msg/Illuminance = std_msgs/Header header; float64 illuminance; float64 variance
sensor_msgs/msg/JoyFeedback = uint8 TYPE_LED=0; uint8 TYPE_RUMBLE=1; uint8 TYPE_BUZZER=2; uint8 type; uint8 id; float32 intensity
sensor_msgs/msg/JoyFeedbackArray = JoyFeedback[] array
sensor_msgs/msg/LaserEcho = float32[] echoes
sensor_msgs/msg/MultiDOFJointState = std_msgs/Header header; string[] joint_names; geometry_msgs/Transform[] transforms; geometry_msgs/Twist[] twist; geometry_msgs/Wrench[] wrench
sensor_msgs/msg/MultiEchoLaserScan = std_msgs/Header header; float32 angle_min; float32 angle_max; float32 angle_increment; float32 time_increment; float32 scan_time; float32 range_min; float32 range_max; LaserEcho[] ranges; LaserEcho[] intensities
sensor_msgs/msg/NavSatFix = uint8 COVARIANCE_TYPE_UNKNOWN=0; uint8 COVARIANCE_TYPE_APPROXIMATED=1; uint8 COVARIANCE_TYPE_DIAGONAL_KNOWN=2; uint8 COVARIANCE_TYPE_KNOWN=3; std_msgs/Header header; NavSatStatus status; float64 latitude; float64 longitude; float64 altitude; float64[9] position_covariance; uint8 position_covariance_type
sensor_msgs/msg/PointCloud = std_msgs/Header header; geometry_msgs/Point32[] points; ChannelFloat32[] channels
sensor_msgs/msg/RelativeHumidity = std_msgs/Header header; float64 relative_humidity; float64 variance
sensor_msgs/srv/SetCameraInfo = CameraInfo camera_info; ---; bool success; string status_message
sensor_msgs/msg/TimeReference = std_msgs/Header header; builtin_interfaces/Time time_ref; string source
sensor_msgs/msg/NavSatStatus = int8 STATUS_UNKNOWN=-2; int8 STATUS_NO_FIX=-1; int8 STATUS_FIX=0; int8 STATUS_SBAS_FIX=1; int8 STATUS_GBAS_FIX=2; uint16 SERVICE_UNKNOWN=0; uint16 SERVICE_GPS=1; uint16 SERVICE_GLONASS=2; uint16 SERVICE_COMPASS=4; uint16 SERVICE_GALILEO=8; int8 status -2; uint16 service

nav_msgs/msg/Odometry = std_msgs/Header header; string child_frame_id; geometry_msgs/PoseWithCovariance pose; geometry_msgs/TwistWithCovariance twist
nav_msgs/msg/Path = std_msgs/Header header; geometry_msgs/PoseStamped[] poses
nav_msgs/msg/MapMetaData = builtin_interfaces/Time map_load_time; float32 resolution; uint32 width; uint32 height; geometry_msgs/Pose origin
nav_msgs/msg/OccupancyGrid = std_msgs/Header header; MapMetaData info; int8[] data
nav_msgs/srv/GetMap = ---; OccupancyGrid map
nav_msgs/srv/GetPlan = geometry_msgs/PoseStamped start; geometry_msgs/PoseStamped goal; float32 tolerance; ---; Path plan
nav_msgs/srv/SetMap = OccupancyGrid map; geometry_msgs/PoseWithCovarianceStamped initial_pose; ---; bool success
nav_msgs/srv/LoadMap = string map_url; ---; uint8 RESULT_SUCCESS=0; uint8 RESULT_MAP_DOES_NOT_EXIST=1; uint8 RESULT_INVALID_MAP_DATA=2; uint8 RESULT_INVALID_MAP_METADATA=3; uint8 RESULT_UNDEFINED_FAILURE=255; OccupancyGrid map; uint8 result
nav_msgs/msg/GridCells = std_msgs/Header header; float32 cell_width; float32 cell_height; geometry_msgs/Point[] cells

visualization_msgs/msg/Marker = int32 ARROW=0; int32 CUBE=1; int32 SPHERE=2; int32 CYLINDER=3; int32 LINE_STRIP=4; int32 LINE_LIST=5; int32 CUBE_LIST=6; int32 SPHERE_LIST=7; int32 POINTS=8; int32 TEXT_VIEW_FACING=9; int32 MESH_RESOURCE=10; int32 TRIANGLE_LIST=11; int32 ARROW_STRIP=12; int32 ADD=0; int32 MODIFY=0; int32 DELETE=2; int32 DELETEALL=3; std_msgs/Header header; string ns; int32 id; int32 type; int32 action; geometry_msgs/Pose pose; geometry_msgs/Vector3 scale; std_msgs/ColorRGBA color; builtin_interfaces/Duration lifetime; bool frame_locked; geometry_msgs/Point[] points; std_msgs/ColorRGBA[] colors; string texture_resource; sensor_msgs/CompressedImage texture; UVCoordinate[] uv_coordinates; string text; string mesh_resource; MeshFile mesh_file; bool mesh_use_embedded_materials
visualization_msgs/msg/UVCoordinate = float32 u; float32 v
visualization_msgs/msg/MeshFile = string filename; uint8[] data
visualization_msgs/msg/MarkerArray = Marker[] markers
visualization_msgs/msg/ImageMarker = int32 CIRCLE=0; int32 LINE_STRIP=1; int32 LINE_LIST=2; int32 POLYGON=3; int32 POINTS=4; int32 ADD=0; int32 REMOVE=1; std_msgs/Header header; string ns; int32 id; int32 type; int32 action; geometry_msgs/Point position; float32 scale; std_msgs/ColorRGBA outline_color; uint8 filled; std_msgs/ColorRGBA fill_color; builtin_interfaces/Duration lifetime; geometry_msgs/Point[] points; std_msgs/ColorRGBA[] outline_colors
visualization_msgs/msg/InteractiveMarker = std_msgs/Header header; geometry_msgs/Pose pose; string name; string description; float32 scale; MenuEntry[] menu_entries; InteractiveMarkerControl[] controls
visualization_msgs/msg/InteractiveMarkerControl = uint8 INHERIT=0; uint8 FIXED=1; uint8 VIEW_FACING=2; uint8 NONE=0; uint8 MENU=1; uint8 BUTTON=2; uint8 MOVE_AXIS=3; uint8 MOVE_PLANE=4; uint8 ROTATE_AXIS=5; uint8 MOVE_ROTATE=6; uint8 MOVE_3D=7; uint8 ROTATE_3D=8; uint8 MOVE_ROTATE_3D=9; string name; geometry_msgs/Quaternion orientation; uint8 orientation_mode; uint8 interaction_mode; bool always_visible; Marker[] markers; bool independent_marker_orientation; string description
visualization_msgs/msg/InteractiveMarkerFeedback = uint8 KEEP_ALIVE=0; uint8 POSE_UPDATE=1; uint8 MENU_SELECT=2; uint8 BUTTON_CLICK=3; uint8 MOUSE_DOWN=4; uint8 MOUSE_UP=5; std_msgs/Header header; string client_id; string marker_name; string control_name; uint8 event_type; geometry_msgs/Pose pose; uint32 menu_entry_id; geometry_msgs/Point mouse_point; bool mouse_point_valid
visualization_msgs/msg/InteractiveMarkerInit = string server_id; uint64 seq_num; InteractiveMarker[] markers
visualization_msgs/msg/InteractiveMarkerPose = std_msgs/Header header; geometry_msgs/Pose pose; string name
visualization_msgs/msg/InteractiveMarkerUpdate = uint8 KEEP_ALIVE=0; uint8 UPDATE=1; string server_id; uint64 seq_num; uint8 type; InteractiveMarker[] markers; InteractiveMarkerPose[] poses; string[] erases
visualization_msgs/msg/MenuEntry = uint8 FEEDBACK=0; uint8 ROSRUN=1; uint8 ROSLAUNCH=2; uint32 id; uint32 parent_id; string title; string command; uint8 command_type

shape_msgs/msg/Mesh = MeshTriangle[] triangles; geometry_msgs/Point[] vertices
shape_msgs/msg/MeshTriangle = uint32[3] vertex_indices
shape_msgs/msg/Plane = float64[4] coef
shape_msgs/msg/SolidPrimitive = uint8 BOX=1; uint8 SPHERE=2; uint8 CYLINDER=3; uint8 CONE=4; uint8 PRISM=5; uint8 BOX_X=0; uint8 BOX_Y=1; uint8 BOX_Z=2; uint8 SPHERE_RADIUS=0; uint8 CYLINDER_HEIGHT=0; uint8 CYLINDER_RADIUS=1; uint8 CONE_HEIGHT=0; uint8 CONE_RADIUS=1; uint8 PRISM_HEIGHT=0; uint8 type; float64[<=3] dimensions; geometry_msgs/Polygon polygon

trajectory_msgs/msg/JointTrajectory = std_msgs/Header header; string[] joint_names; JointTrajectoryPoint[] points
trajectory_msgs/msg/JointTrajectoryPoint = float64[] positions; float64[] velocities; float64[] accelerations; float64[] effort; builtin_interfaces/Duration time_from_start
trajectory_msgs/msg/MultiDOFJointTrajectory = std_msgs/Header header; string[] joint_names; MultiDOFJointTrajectoryPoint[] points
trajectory_msgs/msg/MultiDOFJointTrajectoryPoint = geometry_msgs/Transform[] transforms; geometry_msgs/Twist[] velocities; geometry_msgs/Twist[] accelerations; builtin_interfaces/Duration time_from_start

diagnostic_msgs/msg/DiagnosticArray = std_msgs/Header header; DiagnosticStatus[] status
diagnostic_msgs/msg/DiagnosticStatus = byte OK=0; byte WARN=1; byte ERROR=2; byte STALE=3; byte level; string name; string message; string hardware_id; KeyValue[] values
diagnostic_msgs/msg/KeyValue = string key; string value

stereo_msgs/msg/DisparityImage = std_msgs/Header header; sensor_msgs/Image image; float32 f; float32 t; sensor_msgs/RegionOfInterest valid_window; float32 min_disparity; float32 max_disparity; float32 delta_d

rosgraph_msgs/msg/Clock = builtin_interfaces/Time clock

tf2_msgs/msg/TFMessage = geometry_msgs/TransformStamped[] transforms
tf2_msgs/msg/TF2Error = uint8 NO_ERROR=0; uint8 LOOKUP_ERROR=1; uint8 CONNECTIVITY_ERROR=2; uint8 EXTRAPOLATION_ERROR=3; uint8 INVALID_ARGUMENT_ERROR=4; uint8 TIMEOUT_ERROR=5; uint8 TRANSFORM_ERROR=6; uint8 error; string error_string
tf2_msgs/srv/FrameGraph = ---; string frame_yaml
tf2_msgs/action/LookupTransform = string target_frame; string source_frame; builtin_interfaces/Time source_time; builtin_interfaces/Duration timeout; builtin_interfaces/Time target_time; string fixed_frame; bool advanced; ---; geometry_msgs/TransformStamped transform; tf2_msgs/TF2Error error; ---

turtlesim/msg/Pose = float32 x; float32 y; float32 theta; float32 linear_velocity; float32 angular_velocity
turtlesim/msg/Color = uint8 r; uint8 g; uint8 b
turtlesim/srv/Kill = string name; ---
turtlesim/srv/SetPen = uint8 r; uint8 g; uint8 b; uint8 width; uint8 off; ---
turtlesim/srv/Spawn = float32 x; float32 y; float32 theta; string name; ---; string name
turtlesim/srv/TeleportAbsolute = float32 x; float32 y; float32 theta; ---
turtlesim/srv/TeleportRelative = float32 linear; float32 angular; ---
turtlesim/action/RotateAbsolute = float32 theta; ---; float32 delta; ---; float32 remaining

std_srvs/srv/Empty = ---
std_srvs/srv/SetBool = bool data; ---; bool success; string message
std_srvs/srv/Trigger = ---; bool success; string message

lifecycle_msgs/msg/State = uint8 PRIMARY_STATE_UNKNOWN=0; uint8 PRIMARY_STATE_UNCONFIGURED=1; uint8 PRIMARY_STATE_INACTIVE=2; uint8 PRIMARY_STATE_ACTIVE=3; uint8 PRIMARY_STATE_FINALIZED=4; uint8 TRANSITION_STATE_CONFIGURING=10; uint8 TRANSITION_STATE_CLEANINGUP=11; uint8 TRANSITION_STATE_SHUTTINGDOWN=12; uint8 TRANSITION_STATE_ACTIVATING=13; uint8 TRANSITION_STATE_DEACTIVATING=14; uint8 TRANSITION_STATE_ERRORPROCESSING=15; uint8 id; string label
lifecycle_msgs/msg/Transition = uint8 TRANSITION_CREATE=0; uint8 TRANSITION_CONFIGURE=1; uint8 TRANSITION_CLEANUP=2; uint8 TRANSITION_ACTIVATE=3; uint8 TRANSITION_DEACTIVATE=4; uint8 TRANSITION_UNCONFIGURED_SHUTDOWN=5; uint8 TRANSITION_INACTIVE_SHUTDOWN=6; uint8 TRANSITION_ACTIVE_SHUTDOWN=7; uint8 TRANSITION_DESTROY=8; uint8 TRANSITION_ON_CONFIGURE_SUCCESS=10; uint8 TRANSITION_ON_CONFIGURE_FAILURE=11; uint8 TRANSITION_ON_CONFIGURE_ERROR=12; uint8 TRANSITION_ON_CLEANUP_SUCCESS=20; uint8 TRANSITION_ON_CLEANUP_FAILURE=21; uint8 TRANSITION_ON_CLEANUP_ERROR=22; uint8 TRANSITION_ON_ACTIVATE_SUCCESS=30; uint8 TRANSITION_ON_ACTIVATE_FAILURE=31; uint8 TRANSITION_ON_ACTIVATE_ERROR=32; uint8 TRANSITION_ON_DEACTIVATE_SUCCESS=40; uint8 TRANSITION_ON_DEACTIVATE_FAILURE=41; uint8 TRANSITION_ON_DEACTIVATE_ERROR=42; uint8 TRANSITION_ON_SHUTDOWN_SUCCESS=50; uint8 TRANSITION_ON_SHUTDOWN_FAILURE=51; uint8 TRANSITION_ON_SHUTDOWN_ERROR=52; uint8 TRANSITION_ON_ERROR_SUCCESS=60; uint8 TRANSITION_ON_ERROR_FAILURE=61; uint8 TRANSITION_ON_ERROR_ERROR=62; uint8 TRANSITION_CALLBACK_SUCCESS=97; uint8 TRANSITION_CALLBACK_FAILURE=98; uint8 TRANSITION_CALLBACK_ERROR=99; uint8 id; string label
lifecycle_msgs/msg/TransitionDescription = Transition transition; State start_state; State goal_state
lifecycle_msgs/msg/TransitionEvent = uint64 timestamp; Transition transition; State start_state; State goal_state
lifecycle_msgs/srv/ChangeState = Transition transition; ---; bool success
lifecycle_msgs/srv/GetState = ---; State current_state
lifecycle_msgs/srv/GetAvailableStates = ---; State[] available_states
lifecycle_msgs/srv/GetAvailableTransitions = ---; TransitionDescription[] available_transitions

composition_interfaces/srv/LoadNode = string package_name; string plugin_name; string node_name; string node_namespace; uint8 log_level; string[] remap_rules; rcl_interfaces/Parameter[] parameters; rcl_interfaces/Parameter[] extra_arguments; ---; bool success; string error_message; string full_node_name; uint64 unique_id
composition_interfaces/srv/UnloadNode = uint64 unique_id; ---; bool success; string error_message
composition_interfaces/srv/ListNodes = ---; string[] full_node_names; uint64[] unique_ids

example_interfaces/srv/AddTwoInts = int64 a; int64 b; ---; int64 sum
example_interfaces/srv/SetBool = bool data; ---; bool success; string message
example_interfaces/srv/Trigger = ---; bool success; string message
example_interfaces/action/Fibonacci = int32 order; ---; int32[] sequence; ---; int32[] sequence
action_tutorials_interfaces/action/Fibonacci = int32 order; ---; int32[] sequence; ---; int32[] partial_sequence

service_msgs/msg/ServiceEventInfo = uint8 REQUEST_SENT=0; uint8 REQUEST_RECEIVED=1; uint8 RESPONSE_SENT=2; uint8 RESPONSE_RECEIVED=3; uint8 event_type; builtin_interfaces/Time stamp; char[16] client_gid; int64 sequence_number

action_msgs/msg/GoalInfo = unique_identifier_msgs/UUID goal_id; builtin_interfaces/Time stamp
action_msgs/msg/GoalStatus = int8 STATUS_UNKNOWN=0; int8 STATUS_ACCEPTED=1; int8 STATUS_EXECUTING=2; int8 STATUS_CANCELING=3; int8 STATUS_SUCCEEDED=4; int8 STATUS_CANCELED=5; int8 STATUS_ABORTED=6; GoalInfo goal_info; int8 status
action_msgs/msg/GoalStatusArray = GoalStatus[] status_list
action_msgs/srv/CancelGoal = GoalInfo goal_info; ---; int8 ERROR_NONE=0; int8 ERROR_REJECTED=1; int8 ERROR_UNKNOWN_GOAL_ID=2; int8 ERROR_GOAL_TERMINATED=3; int8 return_code; GoalInfo[] goals_canceling

rcl_interfaces/msg/ParameterType = uint8 PARAMETER_NOT_SET=0; uint8 PARAMETER_BOOL=1; uint8 PARAMETER_INTEGER=2; uint8 PARAMETER_DOUBLE=3; uint8 PARAMETER_STRING=4; uint8 PARAMETER_BYTE_ARRAY=5; uint8 PARAMETER_BOOL_ARRAY=6; uint8 PARAMETER_INTEGER_ARRAY=7; uint8 PARAMETER_DOUBLE_ARRAY=8; uint8 PARAMETER_STRING_ARRAY=9
rcl_interfaces/msg/ParameterValue = uint8 type; bool bool_value; int64 integer_value; float64 double_value; string string_value; byte[] byte_array_value; bool[] bool_array_value; int64[] integer_array_value; float64[] double_array_value; string[] string_array_value
rcl_interfaces/msg/Parameter = string name; ParameterValue value
rcl_interfaces/msg/FloatingPointRange = float64 from_value; float64 to_value; float64 step
rcl_interfaces/msg/IntegerRange = int64 from_value; int64 to_value; uint64 step
rcl_interfaces/msg/ParameterDescriptor = string name; uint8 type; string description; string additional_constraints; bool read_only false; bool dynamic_typing false; FloatingPointRange[<=1] floating_point_range; IntegerRange[<=1] integer_range
rcl_interfaces/msg/SetParametersResult = bool successful; string reason
rcl_interfaces/msg/ListParametersResult = string[] names; string[] prefixes
rcl_interfaces/msg/ParameterEvent = builtin_interfaces/Time stamp; string node; Parameter[] new_parameters; Parameter[] changed_parameters; Parameter[] deleted_parameters
rcl_interfaces/msg/Log = byte DEBUG=10; byte INFO=20; byte WARN=30; byte ERROR=40; byte FATAL=50; builtin_interfaces/Time stamp; uint8 level; string name; string msg; string file; string function; uint32 line
rcl_interfaces/srv/GetParameters = string[] names; ---; ParameterValue[] values
rcl_interfaces/srv/GetParameterTypes = string[] names; ---; uint8[] types
rcl_interfaces/srv/ListParameters = uint64 DEPTH_RECURSIVE=0; string[] prefixes; uint64 depth; ---; ListParametersResult result
rcl_interfaces/srv/DescribeParameters = string[] names; ---; ParameterDescriptor[] descriptors
rcl_interfaces/srv/SetParameters = Parameter[] parameters; ---; SetParametersResult[] results
rcl_interfaces/srv/SetParametersAtomically = Parameter[] parameters; ---; SetParametersResult result
rcl_interfaces/msg/LoggerLevel = uint8 LOG_LEVEL_UNKNOWN=0; uint8 LOG_LEVEL_DEBUG=10; uint8 LOG_LEVEL_INFO=20; uint8 LOG_LEVEL_WARN=30; uint8 LOG_LEVEL_ERROR=40; uint8 LOG_LEVEL_FATAL=50; string name; uint32 level
rcl_interfaces/msg/SetLoggerLevelsResult = bool successful; string reason
rcl_interfaces/srv/GetLoggerLevels = string[] names; ---; LoggerLevel[] levels
rcl_interfaces/srv/SetLoggerLevels = LoggerLevel[] levels; ---; SetLoggerLevelsResult[] results
"""  # noqa: E501 -- one interface a line can be searched and compared

_SAME = {"turtlesim_msgs": "turtlesim"}
"""Packages of newer ROS 2 releases with the same interfaces as an older package."""


@cache
def table() -> dict[str, dict[tuple[str, str], str]]:
    """Return the text of every definition, by package, then by (kind, name)."""
    packages: dict[str, dict[tuple[str, str], str]] = {}
    for line in _TEXT.splitlines():
        name, found, fields = line.partition("=")
        if found:
            package, kind, interface = name.strip().split("/")
            definition = fields.strip().replace("; ", "\n").replace(";", "\n")
            packages.setdefault(package, {})[kind, interface] = definition
    for key, definition in packages["std_msgs"].items():
        if key[1] not in ("Header", "ColorRGBA"):
            packages["example_interfaces"][key] = definition
    for new, old in _SAME.items():
        packages[new] = packages[old]
    return packages


EARLIER: Final = (
    # Definitions up to ROS 2 Humble.
    {
        "sensor_msgs/msg/Range": "uint8 ULTRASOUND=0; uint8 INFRARED=1; std_msgs/Header header; "
        "uint8 radiation_type; float32 field_of_view; float32 min_range; float32 max_range; "
        "float32 range",
    },
    # Definitions up to ROS 2 Foxy.
    {
        "sensor_msgs/msg/Range": "uint8 ULTRASOUND=0; uint8 INFRARED=1; std_msgs/Header header; "
        "uint8 radiation_type; float32 field_of_view; float32 min_range; float32 max_range; "
        "float32 range",
        "shape_msgs/msg/SolidPrimitive": "uint8 type; float64[<=3] dimensions",
        "visualization_msgs/msg/Marker": "std_msgs/Header header; string ns; int32 id; "
        "int32 type; int32 action; geometry_msgs/Pose pose; geometry_msgs/Vector3 scale; "
        "std_msgs/ColorRGBA color; builtin_interfaces/Duration lifetime; bool frame_locked; "
        "geometry_msgs/Point[] points; std_msgs/ColorRGBA[] colors; string text; "
        "string mesh_resource; bool mesh_use_embedded_materials",
    },
)
"""Definitions that earlier distributions had for some types, the latest distribution first.

A recording made before Iron has no definitions: the reader tries which of these fits the bytes.
"""
