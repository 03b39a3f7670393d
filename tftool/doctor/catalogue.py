"""Every check: its id, severity, thresholds, texts and links. The only home of all of them.

An id never changes its meaning, and one that is retired is not used again. Texts are
filled with a finding's facts; see `wording` for how numbers are written.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from tftool.doctor.findings import Area, Fix, Severity

_E, _W, _N = Severity.ERROR, Severity.WARNING, Severity.NOTE
_GITHUB = "https://github.com/"

NEEDS = {
    "log times": "a buffer keeps no log times",
    "recording": "nothing was recorded",
    "headers": "there are no messages with headers",
    "durability": "what publishers offer to late subscribers is not recorded",
    "odometry": "there are no odometry messages",
    "description": "no URDF given",
    "valid description": "the robot description has mistakes",
    "joint states": "there are no joint states",
}
"""What a check may need beside transforms, and what is said where that is missing."""


@dataclass(frozen=True, slots=True)
class Check:
    """What is known of one check.

    Attributes:
        id: Its name, for ever.
        area: What it looks at.
        severity: How bad what it finds is; a hit may say otherwise.
        summary: What is wrong, in one line and in general.
        rule: When it speaks, with its thresholds as {names}.
        headline: What is wrong, with a finding's facts; `{where}` names all of them,
            `{concerned:one|many}` chooses by how many they are, as of any number or list.
        detail: A line of evidence for each hit.
        consequence: What it breaks.
        fixes: What to do, beside what the hit itself says.
        causes: What people found to be behind it, the most frequent first.
        links: Threads about it, and standards.
        limits: Its thresholds by name; seconds, metres, radians, shares, counts.
        needs: Which keys of `NEEDS` it cannot run without.
        why: Why the rule and its thresholds are as they are; empty where that is plain.
    """

    id: str
    area: Area
    severity: Severity
    summary: str
    rule: str
    headline: str
    detail: str = ""
    consequence: str = ""
    fixes: tuple[Fix, ...] = ()
    causes: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    limits: Mapping[str, float] = field(default_factory=dict)
    needs: tuple[str, ...] = ()
    why: str = ""


def _threads(*threads: str) -> tuple[str, ...]:
    """Addresses of threads, each written owner/repository#number."""
    addresses = []
    for thread in threads:
        repository, _, number = thread.partition("#")
        addresses.append(f"{_GITHUB}{repository}/issues/{number}")
    return tuple(addresses)


_REP103 = "https://www.ros.org/reps/rep-0103.html"
_REP105 = "https://www.ros.org/reps/rep-0105.html"

_P, _S, _A, _C = Area.PUBLISHERS, Area.SHAPE, Area.NAMES, Area.CLOCKS
_O, _V, _D = Area.COVERAGE, Area.VALUES, Area.DESCRIPTION

_LIST = (
    Check(
        "two-parents",
        _P,
        _E,
        "a frame gets two parents by turns",
        "a frame has two parents among the statics, or changes its parent more than {switches:g} "
        "times and keeps each for less than {stay:g} s on average",
        "{child} gets its parent by turns from {parents}",
        "{sources}; changes {switches:times}, first at {first:moment}",
        "{lost} {lost:loses its|lose their} way to one root while the other parent rules: the robot jumps, and "
        "lookups fail now and then",
        (
            Fix(
                "let the transform end at the robot's root frame ({root}) instead of {child} "
                "(robot_base_frame, base_frame, LIO-SAM's baselinkFrame), switch one of the two off "
                "(publish_tf: false and its like), or chain them (RTAB-Map's odom_guess_frame_id)"
            ),
        ),
        (
            "visual odometry or SLAM publishes odom to base_link beside the robot description",
            "a driver's base frame is a link below the root",
            "a calibration is published the wrong way round",
        ),
        _threads(
            "stereolabs/zed-ros-wrapper#447",
            "TixiaoShan/LIO-SAM#519",
            "kobuki-base/kobuki_ros#49",
            "introlab/rtabmap_ros#822",
        ),
        {"switches": 4, "stay": 1.0},
        why="a hand-over changes the parent once and stays; a fight changes it at the rate of messages",
    ),
    Check(
        "publisher-conflict",
        _P,
        _E,
        "two sources publish the same transform with different values",
        "two publishers with at least {least:g} samples each overlap in time and are more than "
        "{metres:g} m and one step apart; or, where publishers are unknown, samples continue "
        "(within {reach:g} + {speed:g} m a second) two tracks by turns, each with at least "
        "{samples:g} samples and a share of {share:g}, the owner changing {changes:g} times or more",
        "{edge} is published by {first} and {second} with different values{seen}",
        "{first} and {second}: {rates[0]:.3g} and {rates[1]:.3g} Hz, "
        "latencies {latencies[0]:span} and {latencies[1]:span}, "
        "{apart:m} apart (median), {worst:m} at most",
        "{child} jumps to and fro in {parent}, and everything below it",
        (),
        (
            "a controller or simulator plug-in and a filter publish the odometry",
            "two localisers, or a recorded map to odom replayed beside a live one",
            "two drivers, or two robot_state_publishers",
        ),
        _threads(
            "ros-simulation/gazebo_ros_pkgs#692",
            "ros-controls/ros_controllers#118",
            "introlab/rtabmap_ros#645",
            "iRobotEducation/create3_docs#144",
            "abizovnuralem/go2_ros2_sdk#28",
        ),
        {
            "least": 3,
            "metres": 0.01,
            "reach": 0.05,
            "speed": 3.0,
            "samples": 5,
            "share": 0.1,
            "changes": 6,
        },
        why="a thing that moves continues where it was, while two opinions alternate; so much speed tells two opinions apart, and leaves fast robots and relocalisations alone",
    ),
    Check(
        "static-and-dynamic",
        _P,
        _E,
        "a frame comes on /tf and on /tf_static: its history is wiped each time",
        "a frame is the child of a transform on a static and of one on a dynamic topic",
        "{child} comes on /tf and on /tf_static",
        "moving: {moving}; static: {static}; the kind changes {turns:times}, "
        "at most {history:span} of history are kept",
        "each change of kind wipes the history of {child}: lookups in the past fail",
        (Fix("keep one of the two: what moves on /tf, a mount on /tf_static"),),
        (
            "SLAM beside the robot description, with other parents",
            "an old tf static publisher beside a new one",
            "use_tf_static switched between versions",
        ),
        _threads("TixiaoShan/LIO-SAM#521"),
    ),
    Check(
        "dynamic-on-static",
        _P,
        _W,
        "a moving frame is published as static",
        "a static has {values:g} different values or more (apart by {metres:g} m or {radians:g} rad)",
        "{where} {concerned:moves, and is|move, and are} published as static",
        "{edge}: {values} values, up to {moved:m} and {turned:deg} apart",
        "statics have no history: every lookup in the past silently gives the newest value",
        (Fix("publish what moves with a TransformBroadcaster, on /tf"),),
        ("a calibration or a detector publishes its result with a static broadcaster",),
        (),
        {"values": 4, "metres": 1e-6, "radians": 1e-4},
        why="a recalibration happens once or twice",
    ),
    Check(
        "static-changed",
        _P,
        _W,
        "a static was published again with another value",
        "a static has 2 to {values:g} different values (apart by {metres:g} m or {radians:g} rad)",
        "{where} {concerned:was|were} published again with another value",
        "{edge}: {values} values, {moved:m} and {turned:deg} apart",
        "what was placed with the old value moves when the new one comes, also in the past",
        (Fix("find the second publisher: often two launch files publish the same mount"),),
        ("two launch files", "a recalibration while recording"),
        (),
        {"values": 3, "metres": 1e-6, "radians": 1e-4},
    ),
    Check(
        "static-on-tf",
        _P,
        _N,
        "a constant on /tf that could be static",
        "{samples:g} samples or more on a dynamic topic are all equal while other frames move",
        "{where} never {concerned:changes and is|change and are} sent on /tf",
        "{edge}: {rate:.3g} Hz",
        "lookups through it wait for its next sample: up to its period, and for nothing",
        (Fix("send it once on /tf_static: tf2's static_transform_publisher, use_tf_static: true"),),
        ("the static publisher of the old tf package",),
        _threads("orbbec/ros_astra_camera#89"),
        {"samples": 20},
        why="a static sent at 10 Hz lets every lookup wait for up to 100 ms",
    ),
    Check(
        "parent-switch",
        _P,
        _N,
        "a frame changed its parent and stayed",
        "a frame changes its parent at most {switches:g} times, or keeps each for {stay:g} s or more",
        "{child} changed its parent: {parents}",
        "{child}: {switches:times}",
        "fine for an object that was picked up; a mount never does it",
        (),
        ("an object that was picked up",),
        (),
        {"switches": 4, "stay": 1.0},
    ),
    Check(
        "loop",
        _S,
        _E,
        "frames hang from each other in a circle",
        "the transforms that exist at the same time form a circle",
        "the frames hang in a circle: {circle}",
        "",
        'whatever walks to the root fails: "The tf tree is invalid because it contains a loop."',
        (Fix("publish one direction only"),),
        ("odom above body and body above odom at once",),
        _threads("rai-opensource/spot_ros2#374"),
    ),
    Check(
        "split-tree",
        _S,
        _E,
        "the frames form more than one tree, and the join is missing",
        "there is more than one root; an error where messages are in a frame of a lesser tree, "
        "a note where each tree is a whole robot",
        "{root} is not joined to the tree of {main_root}",
        "tree {number}: {frames}; used by {used}",
        "nothing in it can be placed in {main_root}, and nothing of {main_root} in it",
        (),
        (
            "the mount of a camera or lidar was never published",
            "a SLAM has names of its own (camera_init, body)",
            "base_frame is named differently in two nodes",
            "SLAM or AMCL was not started yet: there is no map",
        ),
        _threads(
            "appliedAI-Initiative/orb_slam_2_ros#102",
            "hku-mars/FAST_LIO#130",
            "kinglintianxia/autolabor_pro1#2",
        ),
    ),
    Check(
        "self-transform",
        _S,
        _E,
        "a frame is its own parent",
        "parent and child of a transform are the same name",
        "{where}: a frame is its own parent",
        "{frame}: {count:times}",
        "tf2 drops it: the transform that was meant is missing",
        (Fix("two options of the publisher name one frame for two roles: give each its own"),),
        (
            "published_frame and odom_frame of cartographer are equal",
            "base frame and odometry frame of rf2o are equal",
        ),
        _threads("cartographer-project/cartographer#1883", "ethz-asl/voxblox#315"),
    ),
    Check(
        "empty-frame",
        _S,
        _E,
        "a transform or a message without a frame name",
        "a name is empty: an error in a transform, a warning in the header of a message that "
        "has a place",
        "{what} has no frame name",
        "{what}: {detail}, {count:times}",
        "tf2 drops such a transform, and such a message can be placed nowhere",
        (Fix("set frame_id in the driver that publishes it"),),
        ("a message that was never filled", "a camera whose frame id was never set"),
        _threads("christianrauch/apriltag_ros#57", "Intermodalics/tango_ros#157"),
    ),
    Check(
        "rep105-shape",
        _S,
        _W,
        "map, odom and base are not in one line",
        "map and odom exist and base hangs from map beside odom; or odom hangs from a base that "
        "is below map; or base_footprint and base_link both hang from odom",
        "map, odom and base are not in one line: {where}",
        "{found}",
        "navigation expects map above odom above base (REP-105); a frame has one parent",
        (
            Fix(
                "let the localiser publish odom in map: (base in map) times the inverse of "
                "(base in odom)"
            ),
        ),
        ("a localiser publishes map to base_link",),
        (_REP105, *_threads("rsasaki0109/lidar_slam_ros2#86", "ros-navigation/navigation2#5095")),
    ),
    Check(
        "unknown-frame",
        _A,
        _E,
        "messages are in a frame that no transform mentions",
        "the frame of a message that has a place is in no transform of the whole recording",
        "no transform names {frame}",
        "{says}{hint}",
        "none of these messages can be placed anywhere",
        (),
        (
            "a simulator's scoped name (robot/base_link/gpu_lidar)",
            "the driver's default frame_id (laser, imu) against the robot description's",
            "a prefix applied twice",
            "a static that was never published",
        ),
        _threads("Ekumen-OS/andino_gz#43", "ros2/ros2_documentation#5222", "osrf/vrx#876"),
        needs=("headers",),
        why="lookups fail by name before any question of time",
    ),
    Check(
        "slash-twins",
        _A,
        _E,
        "messages say /x, tf knows x: every lookup refuses",
        "a frame in a header begins with a slash, and tf knows the rest of the name",
        "{topic} says {frame}, tf knows {known}",
        "{topic}: {frame}, {count:times}",
        "every lookup refuses: \"in tf2 frame_ids cannot start with a '/'\"",
        (
            Fix('set frame_id to "{known}" in the publisher of {topic}'),
            Fix("in a recording:", "tftool edit RECORDING -o CLEAN --strip-slash --everywhere"),
        ),
        ("a publisher from the days of tf 1",),
        _threads("ros-simulation/stage_ros#68", "gisbi-kim/FAST_LIO_SLAM#15"),
        needs=("headers",),
    ),
    Check(
        "leading-slash",
        _A,
        _N,
        "names in transforms carry a leading slash",
        "a transform names a frame with a leading slash, which tf2 strips; an error where it has "
        "two, since no query can reach what is left",
        "{where} {concerned:is|are} published with a leading slash",
        "{edge}: {found}",
        "harmless to tf2; what compares names sees two",
        (Fix("drop the slash in the publisher"),),
        ("a publisher from the days of tf 1",),
    ),
    Check(
        "case-twins",
        _A,
        _W,
        "names that differ in case, hyphens, underscores or blanks only",
        "two names are equal without hyphens, underscores, blanks and case",
        "{first} and {second} differ in their writing only",
        "{users}",
        "they are two frames; what is placed in one is not in the other",
        (Fix("use one spelling; {most} has more users"),),
        ("names typed by hand in two places",),
    ),
    Check(
        "typo-twins",
        _A,
        _W,
        "names one or two letters apart, one of them dangling",
        "two names of {shortest:g} letters or more, not in one tree, differ by one letter (from "
        "{long:g} letters on: by two), and one is unknown to tf or the root of a lesser tree; "
        "numbers and pairs like left and right aside",
        "{first} and {second} look like one name",
        "{users}",
        "they are two frames; what is placed in one is not in the other",
        (Fix("use one spelling; {most} has more users"),),
        ("names typed by hand in two places",),
        (),
        {"shortest": 5, "long": 10},
    ),
    Check(
        "namespace-twins",
        _A,
        _W,
        "part of the frames carry a prefix that others lack",
        "a name exists with and without a prefix, in different trees",
        "{first} and {bare} look like one frame: some names carry the prefix {prefix}",
        "{twins}",
        "the frames with the prefix and those without are two trees",
        (
            Fix(
                "use one scheme: prefix all names (frame_prefix: {prefix}), or none and remap "
                "/tf:=tf and /tf_static:=tf_static in every node"
            ),
        ),
        (
            "diff_drive_controller prefixes names with its namespace, robot_state_publisher does not",
            "frame_prefix without its trailing slash, or on names that have it already",
        ),
        _threads(
            "iRobotEducation/create3_sim#211",
            "ros-controls/ros2_controllers#533",
            "ros/robot_state_publisher#205",
        ),
    ),
    Check(
        "namespaced-topic",
        _A,
        _W,
        "transforms travel on /ns/tf, where default listeners do not listen",
        "transforms come on a topic other than /tf and /tf_static; a note where /tf is whole "
        "without it",
        "transforms travel on {topics}",
        "{missing}",
        "a listener with its defaults does not hear them",
        (),
        ("a robot in a namespace whose /tf is remapped",),
        _threads("iRobotEducation/create3_docs#402", "ros-navigation/navigation2#5449"),
    ),
    Check(
        "awkward-name",
        _A,
        _N,
        "a name with blanks, control characters, or that YAML reads as a number or a word",
        "a name has blanks at its ends, characters that cannot be seen, a ~, more than "
        "{letters:g} letters, or is a number or word of YAML 1.1",
        "{where}: names that tools stumble over",
        "{frame} {reason}",
        "tools that print or parse the name show or read another one",
        (Fix("give the frame a plain name: letters, digits, underscores"),),
        limits={"letters": 100},
    ),
    Check(
        "clock-mixture",
        _C,
        _E,
        "part of the stamps count from the simulation's start, part from 1970",
        "stamps below 10⁸ s and above it occur together; the odd ones are those against /clock, "
        "else the fewer",
        "{where} {concerned:is|are} stamped with {odd_clock}, all else with {usual_clock}",
        "for example {odd_stamp:dated} beside {usual_stamp:dated}",
        "no lookup across the two clocks can succeed",
        (
            Fix(
                "use_sim_time: {setting} for the nodes that publish them; "
                "`ros2 param get NODE use_sim_time` tells what a node has"
            ),
        ),
        (
            "one node without use_sim_time",
            "simulated time set on a real robot",
            "a real sensor on a simulated robot",
        ),
        _threads("ANYbotics/elevation_mapping#122", "iRobotEducation/create3_sim#203"),
    ),
    Check(
        "future-stamp",
        _C,
        _W,
        "transforms dated ahead of their arrival",
        "the median latency of a transform is below -{seconds:g} s (of what places odometry in a "
        "map: -{localisation:g} s); a note from -{note:g} s on",
        "{where} {concerned:is|are} dated {ahead:span} ahead of {concerned:its|their} arrival",
        "{edge}: {ahead:span} ahead (median){clock}",
        "the latest common time lies in the future: a lookup at latest mixes moments",
        (
            Fix(
                "lower the tolerance that dates it ahead (transform_tolerance, "
                "transform_time_offset), or set the publisher's clock"
            ),
        ),
        ("a tolerance that is too large", "the publisher's clock is ahead"),
        _threads("ros-navigation/navigation2#3166"),
        {"seconds": 0.25, "localisation": 2.0, "note": 0.02},
        ("log times",),
        why="AMCL dates its transform 1 s ahead, and offsets of 0.1 s are in use",
    ),
    Check(
        "wild-stamp",
        _C,
        _W,
        "single stamps far from those before and after",
        "at most one stamp in a hundred, or one, lies more than an hour from where those of the "
        "arrivals before and after lie",
        "{where} {concerned:has|have} a stamp that lies {off:span} {side} the others",
        "{what}: {count} of {of}, {stamp:dated}",
        "a transform stamped ahead has tf2 drop what follows, until time reaches it; one that is "
        "stamped behind is dropped itself",
        (
            Fix(
                "look at what the publisher stamps from; `tftool edit --from A --to B` leaves out "
                "of a recording what is stamped outside"
            ),
        ),
        (
            "memory that was never set, or a number read with the wrong bytes",
            "one message stamped before the clock was set",
        ),
        (),
        needs=("log times",),
        why="a late message or a slow clock is off by seconds, and its neighbours are, too",
    ),
    Check(
        "stale-stamp",
        _C,
        _W,
        "transforms or messages dated long before their arrival",
        "the median latency is above {transforms:g} s for a transform (an error above the cache) "
        "or {messages:g} s for messages",
        "{where} {concerned:is|are} dated {late:span} before {concerned:its|their} arrival",
        "{what}: {late:span} late (median)",
        "lookups at the present refuse; in rviz it lags or vanishes",
        (
            Fix(
                "stamp each transform when it is made, not with the last measurement's stamp; "
                "compare the clocks (chronyc tracking)"
            ),
        ),
        (
            "the stamp is copied from an old measurement",
            "the publisher's clock is behind",
            "a slow network",
        ),
        _threads("cartographer-project/cartographer_ros#143"),
        {"transforms": 0.5, "messages": 2.0},
        ("log times",),
    ),
    Check(
        "clock-offset",
        _C,
        _W,
        "a sensor's messages come from the future: two clocks",
        "the median latency of a sensor's messages is below -{seconds:g} s (of a laser scan: one "
        "scan more); a note where steady streams (95 % within {spread:g} s, {samples:g} messages) "
        "form groups more than {apart:g} s apart",
        "{topic} is {ahead:span} off the other clocks",
        "{groups}",
        "each lookup at its stamps asks for what is not there yet, by the same amount for ever",
        (
            Fix(
                "synchronise the clocks: chrony with one computer as server, PTP for lidars, or the "
                "driver's timestamp mode"
            ),
            Fix("not a larger timeout: a constant offset eats it for ever"),
        ),
        (
            "robot base and single-board computer",
            "robot and desk computer",
            "a lidar in its own time",
        ),
        _threads(
            "turtlebot/turtlebot4_robot#8", "DFKI-NI/mir_robot#7", "ROBOTIS-GIT/turtlebot3#618"
        ),
        {"seconds": 0.02, "spread": 0.02, "apart": 0.05, "samples": 20},
        ("log times", "headers"),
        why="a message cannot be older than itself; 20 ms are more than stamps are rounded by, and a scan may be stamped with its end",
    ),
    Check(
        "zero-stamp",
        _C,
        _W,
        "a moving frame with stamp 0",
        "a transform on a dynamic topic has stamp 0",
        "{where} {concerned:has|have} stamp 0",
        "{edge}: {count} of {of} samples",
        "lookups at any other time refuse; 0 means latest in every question",
        (Fix("stamp it: t.header.stamp = self.get_clock().now().to_msg(), inside the loop"),),
        ("the stamp is never set", "use_sim_time without /clock"),
    ),
    Check(
        "frozen-stamp",
        _C,
        _W,
        "the stamp stands still while the message repeats",
        "one stamp comes {times:g} times or more, over more than {seconds:g} s",
        "the stamp of {where} stands still",
        "{edge}: {stamp:moment} {count:times}, for {lasted:span}",
        "lookups at any other time refuse: only that one is in the buffer",
        (Fix("set the stamp inside the loop: t.header.stamp = self.get_clock().now().to_msg()"),),
        ("the stamp is set once, before the loop",),
        (),
        {"times": 10, "seconds": 1.0},
        ("log times",),
    ),
    Check(
        "repeated-stamp",
        _C,
        _W,
        "the same stamp twice: TF_REPEATED_DATA in ROS 1",
        "more than {samples:g} samples, and a share above {share:g}, repeat a stamp with the same value",
        "{where} {concerned:repeats|repeat} stamps",
        "{edge}: {count} of {of} samples repeat a stamp",
        "ROS 1 prints TF_REPEATED_DATA for each; ROS 2 ignores equal ones and lets the later of "
        "different ones win",
        (Fix("send a transform only when its stamp is newer than the last one's"),),
        (
            "a filter publishes faster than its data",
            "the same pose is sent once per sensor",
            "two nodes with one frame",
        ),
        _threads("at-wat/neonavigation#612", "uf-mil/mil#1097"),
        {"samples": 2, "share": 0.05},
    ),
    Check(
        "time-jump-back",
        _C,
        _E,
        "time went back: a looped bag, a reset simulation",
        "within 1 s at least half of all streams, and two, step back by more than 1 s",
        "time went back by {back:span}, {count:times}",
        "at log time {moment:moment}: from {before:moment} to {after:moment}, {streams} streams; "
        "all that follows is about what came before",
        "C++ listeners clear their buffers, Python ones up to humble refuse all new data as old "
        "(TF_OLD_DATA) until the old time is reached again",
        (
            Fix(
                "play with --clock and set use_sim_time: true; in Python on humble restart, or "
                "clear the buffer"
            ),
        ),
        ("play --loop", "a simulation was reset", "NTP set the clock back while running"),
        _threads("ros2/geometry2#606", "ros/geometry2#43"),
        needs=("log times",),
        why="a looped recording would trip forty other checks: all of them look at the first lap only",
    ),
    Check(
        "old-data",
        _C,
        _W,
        "samples older than the cache allows: TF_OLD_DATA",
        "a sample is older than the newest of its frame by more than the cache (--cache-time)",
        "{where} {concerned:sends|send} samples that are too old to be kept",
        "{edge}: {count:times}, up to {behind:span} behind",
        "tf2 drops them and warns TF_OLD_DATA",
        (Fix("restart the publisher that still has the old clock; or clear the buffer"),),
        ("a restarted publisher or simulation", "a replayed recording beside the live robot"),
        _threads("ros/geometry2#43"),
    ),
    Check(
        "out-of-order",
        _C,
        _N,
        "samples overtake each other within the cache",
        "more than {samples:g} samples, and a share above {share:g}, are older than one before",
        "{where} {concerned:comes|come} out of order",
        "{edge}: {count} of {of} samples",
        "harmless to tf2; hints at threads, or at a second publisher",
        (),
        (),
        (),
        {"samples": 2, "share": 0.01},
    ),
    Check(
        "edge-stopped",
        _O,
        _E,
        "a transform ends long before the recording does",
        "the last sample comes more than {periods:g} periods and {seconds:g} s, and a share of "
        "{share:g}, before the recording's end, while others go on",
        "{where} {concerned:stops|stop} before the end",
        "{edge}: last at {last:moment}, {before:span} before the end; came every {period:span}",
        "lookups through it refuse from then on",
        (Fix("look at the node that publishes it: it died, or hangs"),),
        ("a node that crashed", "a lost sensor"),
        (),
        {"periods": 10, "seconds": 1.0, "share": 0.05},
        ("log times",),
    ),
    Check(
        "gap",
        _O,
        _W,
        "a hole in a transform",
        "the largest step is above {periods:g} periods and {seconds:g} s, of {samples:g} samples or "
        "more; a note for what is published on change (variation above {variation:g})",
        "{where} {concerned:has a hole|have holes}",
        "{edge}: nothing from {begin:moment} to {end:moment} ({length:span}; usually every "
        "{period:span}){why}{beside}",
        "lookups inside it interpolate over the hole, or refuse while it lasts",
        (Fix("look at what stopped then: all edges together mean the recorder or the network"),),
        ("load", "a network that drops", "a publisher that hung"),
        (),
        {"periods": 5, "seconds": 0.5, "samples": 10, "variation": 1.0},
        why="four messages lost in a row are no chance on a reliable topic, and shorter holes are covered by the waits that consumers have anyway",
    ),
    Check(
        "single-sample",
        _O,
        _W,
        "a moving frame with one sample only",
        "a transform on a dynamic topic came once",
        "{where} {concerned:was|were} sent once, on /tf",
        "{edge}: at {stamp:moment}",
        "one sample answers for its own stamp only, and only for as long as the cache keeps it",
        (Fix("send a mount with a StaticTransformBroadcaster (on /tf_static)"),),
        ("a mount sent with a TransformBroadcaster",),
        why="tf2 interpolates between two samples and never extrapolates from one",
    ),
    Check(
        "no-transforms",
        _O,
        _E,
        "there is no tf in it at all",
        "no topic carries a transform",
        "there are no transforms",
        "",
        "nothing can be placed in anything",
        (Fix("record /tf and /tf_static too"),),
        ("/tf and /tf_static were not in the recorder's list",),
    ),
    Check(
        "static-missing",
        _O,
        _E,
        "no statics in the recording, and sensors hang in the air",
        "no static topic has a message, and messages are in frames that tf does not know",
        "the statics are missing: {why}",
        "messages are in {frames}, which no transform names",
        "these sensors can be placed nowhere",
        (
            Fix("record with /tf and /tf_static (ROS 1: rosbag record --repeat-latched)"),
            Fix(
                "take the statics from the first part of the recording, or the robot description:",
                "tftool edit RECORDING -o WHOLE --statics-from FIRST_PART",
            ),
        ),
        (
            "the second part of a split recording",
            "/tf_static not in the recorder's list",
            "the recorder's QoS for /tf_static",
        ),
        _threads("ros/geometry2#181", "ros/ros_comm#706"),
        needs=("headers",),
    ),
    Check(
        "static-not-latched",
        _O,
        _E,
        "/tf_static is offered volatile: late listeners never get it",
        "a publisher offers a static topic with durability volatile",
        "{topic} is offered volatile by {by}",
        "",
        "a listener that starts later never gets these statics",
        (Fix("publish it with durability transient_local (a StaticTransformBroadcaster does)"),),
        ("a relay or bridge with default QoS",),
        _threads("ros2/geometry2#585", "realsenseai/realsense-ros#141"),
        needs=("durability",),
    ),
    Check(
        "static-late",
        _O,
        _W,
        "statics arrive after what needs them",
        "a static first arrives more than {seconds:g} s after the first message in a frame below it",
        "{where} {concerned:arrives after what needs it|arrive after what needs them}",
        "{edge}: {late:span} late; before it: {missed}",
        "a listener that was there from the start could not place these messages, although the "
        "recording can",
        (Fix("start the publisher of the statics before the sensors"),),
        ("a driver that publishes its mount when it is ready",),
        _threads("ros/geometry2#181"),
        {"seconds": 1.0},
        ("log times", "headers"),
    ),
    Check(
        "latched-overwrite",
        _O,
        _N,
        "statics are spread over several messages; playback latches the last",
        "the last static message does not hold all children",
        "statics are spread over {messages} messages",
        "the last lacks {lost}",
        "a player that publishes them from one node keeps only the last for late listeners",
        (
            Fix("start listeners before playing"),
            Fix(
                "or bring them into one message:", "tftool edit RECORDING -o WHOLE --statics-first"
            ),
        ),
        ("several static publishers",),
        _threads("ros/ros_comm#706", "ros2/geometry2#585"),
        needs=("recording",),
    ),
    Check(
        "sensor-outruns-tf",
        _O,
        _W,
        "lookups at the sensor's stamps refuse; how many, and what wait cures them",
        "95 % of the waits for the last transform a message needs are not below {seconds:g} s, or a "
        "share above {never:g} is never served; a note where a share above {refused:g} waits and "
        "95 % are not below {note:g} s; of {messages:g} messages or more",
        "{topic} arrives before the transforms it needs",
        "{refused:%} refused at arrival (in {fixed}); wait {p50:span} (median), {p95:span} (95 %), "
        "{worst:span} (worst); {never:%} never served; held up by {link}, every {period:span}, "
        "{latency:span} after its stamp",
        '"extrapolation into the future", or a message filter that drops messages because its '
        "queue is full",
        (),
        (
            "odometry is slower or later than the sensor",
            "the clocks of two computers",
            "a constant on /tf at 10 Hz",
            "load",
        ),
        _threads(
            "SteveMacenski/slam_toolbox#516",
            "SteveMacenski/slam_toolbox#576",
            "ApolloAuto/apollo#12088",
        ),
        {"seconds": 0.1, "never": 0.05, "refused": 0.5, "note": 0.03, "messages": 5},
        ("log times", "headers"),
        why="0.1 s is the usual tolerance of consumers, and a healthy robot at 50 Hz needs 20 ms for some scans",
    ),
    Check(
        "cache-short",
        _O,
        _W,
        "messages are older than the cache when they arrive",
        "95 % of a topic's messages do not arrive within the cache (10 s; --cache-time)",
        "{topic} arrives after the cache has forgotten its moment",
        "{topic}: {late:span} after its stamp (median), {worst:span} at most; the buffer keeps "
        "{cache:span}",
        '"extrapolation into the past": the transforms it needs were dropped',
        (
            Fix(
                "keep more (ROS 1's Python ignores this argument: ros_comm#2270)",
                "Buffer(cache_time=Duration(seconds={needed}))",
            ),
            Fix("or look up when the measurement arrives, and keep the result"),
        ),
        ("a slow detector", "a consumer that is behind"),
        _threads("intrinsic-dev/aic#218"),
        {},
        ("log times", "headers"),
    ),
    Check(
        "late-start",
        _O,
        _N,
        "lookups cannot succeed before a moment: an edge begins late or is dated ahead",
        "messages are older by more than {seconds:g} s, and the first second of the recording, than "
        "the first transform they need; where a localiser dates that ahead, by up to 2 s, so much more",
        "{where} {concerned:begins after the messages that need it|begin after the messages that need them}",
        "{edge} begins at {begin:moment}: {lost} messages of {topic} can never be placed in {fixed}",
        "waiting does not help; skip them",
        (),
        ("AMCL dates its first transform ahead (transform_tolerance)", "a node that starts later"),
        (),
        {"seconds": 0.5},
        ("log times", "headers"),
        why="the first second of every recording is a start, and a localiser that dates ahead loses it always",
    ),
    Check(
        "truncated-recording",
        _O,
        _N,
        "the recorder was killed, or the file is damaged: read up to there",
        "part of the recording could not be read",
        "part of the recording could not be read",
        "{damage}",
        "what is behind the damage is not in this report",
        (),
        ("the recorder was killed", "a full disk"),
    ),
    Check(
        "nan-transform",
        _V,
        _E,
        "NaN or infinity in a transform",
        "a number of a transform is NaN or infinite",
        "{where} {concerned:has|have} numbers that are none",
        "{edge}: {count} of {of} samples, first at {first:moment}: {numbers}; {fate}",
        "the frame stands still or vanishes; what is placed through it is nowhere",
        (
            Fix(
                "look at the source: a division by zero, a filter that diverged, a joint without state"
            ),
        ),
        (
            "an estimator or simulation that diverged",
            "a NaN joint command",
            "a message that was never filled",
        ),
        _threads("moveit/moveit2#298", "NVIDIA-ISAAC-ROS/isaac_ros_nvblox#16"),
    ),
    Check(
        "bad-quaternion",
        _V,
        _E,
        "a rotation of length zero, or of a length that is off",
        "a quaternion's squared length is below 10⁻¹² (an error), or off by more than {length:g} "
        "(a warning)",
        "{where} {concerned:has|have} rotations that are none",
        "{edge}: {count} of {of} samples, first {numbers} (length {length:.4g}); {fate}",
        "the frame exists for one listener and not for another",
        (Fix("fill the rotation (w = 1 for none), and normalise it before sending"),),
        (
            "a message that was never filled (w = 0)",
            "decimals typed by hand",
            "zero extrinsics in a camera",
        ),
        _threads(
            "robomechanics/quad-sdk#346", "introlab/rtabmap_ros#153", "CCNYRoboticsLab/imu_tools#67"
        ),
        {"length": 0.01},
        why="ROS 1 drops such a transform and ROS 2 normalises it: the frame is in one and not in the other",
    ),
    Check(
        "teleport",
        _V,
        _W,
        "a frame jumps faster than anything moves",
        "a step above {metres:g} m faster than {speed:g} m/s (or above {radians:g} rad faster than "
        "{turning:g} rad/s) and than {times:g} times the 95 % speed, in a share of {share:g} of the "
        "steps or {few:g} of them; of {samples:g} samples or more",
        "{where} {concerned:jumps|jump} {jump:m} within {within:span}",
        "{edge}: {jump:m} and {turn:deg} at {at:moment}, {count:times}; usual {usual:.2g} m/s",
        "what is placed before and after does not fit{also}",
        (
            Fix(
                "look at the source at that moment: encoder overflow, a reset of the filter, wheel slip"
            ),
        ),
        ("encoder overflow", "a reset of the filter", "wheel slip"),
        (*_threads("ROBOTIS-GIT/turtlebot3#926"), _REP105),
        {
            "metres": 0.25,
            "speed": 10.0,
            "radians": 0.5,
            "turning": 20.0,
            "times": 8.0,
            "share": 0.02,
            "few": 3,
            "samples": 10,
        },
        why="what moves steadily has a usual speed; more jumps than that are noise, or two publishers",
    ),
    Check(
        "optical-convention",
        _V,
        _W,
        "an _optical frame without optical axes",
        "an optical frame's turn in its body frame is more than {degrees:g}° off optical axes (z "
        "forward, x right); where they share a name or lie within {metres:g} m",
        "{where} {concerned:does|do} not have optical axes",
        "{edge}: {off:.3g}° off",
        "images and clouds in it are turned on their side",
        (Fix('make it a fixed joint with rpy="-1.5708 0 -1.5708", and name it in the driver'),),
        ("the optical frame was given the axes of the body",),
        (_REP103, *_threads("ros-simulation/gazebo_ros_pkgs#1329")),
        {"degrees": 5.0, "metres": 0.1},
        why="calibrated cameras are off by up to 5°",
    ),
    Check(
        "image-not-optical",
        _V,
        _N,
        "images stamped in a body frame",
        'a picture\'s frame has no "optical" in its name',
        "{where} {concerned:is|are} not in an optical frame",
        "{topic} is in {frame}",
        "what projects its pixels looks along the wrong axis",
        (Fix('add a fixed joint with rpy="-1.5708 0 -1.5708", and name its frame in the driver'),),
        ("the driver has one frame for body and picture",),
        (_REP103, *_threads("usnistgov/ARIAC#345")),
        needs=("headers",),
    ),
    Check(
        "odometry-tf-mismatch",
        _V,
        _W,
        "odometry message and transform of one name disagree",
        "an Odometry message and the transform of the same two names and the same stamp are more "
        "than {metres:g} m or {degrees:g}° apart, in a share above {share:g} of such pairs; a note "
        "where tf has no transform of these names",
        "{topic} and tf disagree about {edge}",
        "{found}",
        "what uses the message and what uses tf believe the robot in different places",
        (Fix("let one node publish both, from one estimate"),),
        (
            "the message is the wheels', the transform a filter's",
            "the filter's publish_tf is off and another node sends the transform",
        ),
        (),
        {"metres": 0.05, "degrees": 2.0, "share": 0.5},
        ("odometry",),
    ),
    Check(
        "suspect-units",
        _V,
        _N,
        "a mount far from its parent inside one robot: millimetres?",
        "a static below a base frame is longer than {metres:g} m",
        "{where} {concerned:is|are} far away for a mount",
        "{edge}: {away:m}",
        "if it was meant in millimetres, everything below is a thousand times too far",
        (Fix("look whether it is in millimetres: tf is in metres"),),
        ("a CAD export in millimetres",),
        (),
        {"metres": 10.0},
    ),
    Check(
        "suspect-order",
        _V,
        _N,
        "a static of exactly (1, 0, 0, 0): w first by mistake?",
        "a static's rotation is exactly x = 1, y = z = w = 0",
        "{where} {concerned:is|are} turned over: (1, 0, 0, 0)",
        "{edge}: a half turn about x, or no turn written w first",
        "if no turn was meant, the frame is upside down",
        (Fix("write quaternions as x y z w: no turn is 0 0 0 1"),),
        ("a quaternion written w first",),
    ),
    Check(
        "urdf-invalid",
        _D,
        _E,
        "the robot description has mistakes",
        "it is no XML, has no root or several, a joint names a link that is missing, joints form a "
        "circle, or a name comes twice",
        "the robot description cannot be read",
        "{mistakes}",
        "robot_state_publisher refuses it or publishes a part; nothing is compared with it",
        (Fix("mend the description: `tftool info FILE` shows each mistake in its line"),),
        ("a link was renamed and its joint was not", "xacro that was not expanded"),
        needs=("description",),
    ),
    Check(
        "joint-without-state",
        _D,
        _E,
        "a movable joint has no state, so its link has no frame",
        "a joint that moves and follows no other is in no JointState of the recording, and no "
        "transform has its link",
        "{joint} has no state: {child} has no frame",
        "{joint} ({kind}) moves {below}",
        "robot_state_publisher publishes nothing below such a joint",
        (
            Fix(
                "start joint_state_publisher or the controller's broadcaster; or make the joint "
                "fixed"
            ),
        ),
        (
            "joint_state_publisher or the joint state broadcaster was not started",
            "a plug-in publishes the driven joints only",
            "casters",
        ),
        _threads("LeoRover/leo_simulator#6", "iRobotEducation/create3_sim#203"),
        needs=("description", "valid description", "joint states"),
    ),
    Check(
        "urdf-frame-unpublished",
        _D,
        _W,
        "a link of the robot description never appears in tf",
        "a link of the robot description is in no transform of the whole recording",
        "{where} of the robot description: in no transform",
        "{frame}: {reason}",
        "nothing can be placed in these frames",
        (),
        (
            "robot_state_publisher does not run, or with another description",
            "/tf_static was not recorded",
            "a movable joint has no state",
        ),
        _threads("iRobotEducation/create3_sim#203"),
        needs=("description", "valid description"),
    ),
    Check(
        "urdf-tf-mismatch",
        _D,
        _W,
        "a static differs from the robot description's fixed joint",
        "a static and the fixed joint of the same two links are more than {metres:g} m or "
        "{degrees:g}° apart",
        "{where} {concerned:differs|differ} from the robot description",
        "{edge}: {apart:m} and {turned:deg} apart; {joint} has {says}, tf {has}",
        "what was calibrated and what is published are two mounts",
        (Fix("publish it once: take the second publisher away, or write the calibration down"),),
        (
            "a calibration is published beside the description",
            "the robot runs with an older description",
        ),
        (),
        {"metres": 0.001, "degrees": 0.1},
        ("description", "valid description"),
    ),
)

CHECKS: Mapping[str, Check] = {check.id: check for check in _LIST}
"""Every check by its id, in the order of the report: by area, then as in the page of checks."""

FOLDS: tuple[tuple[tuple[str, ...], tuple[str, ...], str], ...] = (
    (
        ("time-jump-back",),
        ("old-data", "out-of-order", "repeated-stamp", "stale-stamp", "teleport"),
        "anything",
    ),
    (
        ("clock-mixture",),
        (
            "future-stamp",
            "stale-stamp",
            "clock-offset",
            "sensor-outruns-tf",
            "late-start",
            "cache-short",
            "edge-stopped",
            "out-of-order",
        ),
        "stream",
    ),
    (
        ("publisher-conflict", "two-parents"),
        (
            "teleport",
            "repeated-stamp",
            "out-of-order",
            "split-tree",
            "rep105-shape",
            "gap",
            "parent-switch",
            "edge-stopped",
            "old-data",
        ),
        "child",
    ),
    (
        ("static-and-dynamic",),
        ("parent-switch", "static-on-tf", "single-sample", "static-late"),
        "child",
    ),
    (("static-missing",), ("unknown-frame", "split-tree"), "anything"),
    (("static-missing", "unknown-frame", "split-tree"), ("urdf-frame-unpublished",), "frame"),
    (
        ("slash-twins", "namespace-twins", "case-twins", "typo-twins"),
        ("unknown-frame", "split-tree", "rep105-shape"),
        "frame",
    ),
    (("namespace-twins",), ("typo-twins", "case-twins"), "frame"),
    (
        ("namespaced-topic",),
        ("static-missing", "no-transforms", "unknown-frame", "split-tree"),
        "anything",
    ),
    (("namespaced-topic",), ("split-tree",), "frame"),
    (("joint-without-state",), ("urdf-frame-unpublished", "split-tree"), "frame"),
    (
        (
            "gap",
            "edge-stopped",
            "stale-stamp",
            "clock-offset",
            "zero-stamp",
            "frozen-stamp",
            "single-sample",
            "nan-transform",
            "future-stamp",
        ),
        ("sensor-outruns-tf",),
        "path",
    ),
    (("wild-stamp",), ("old-data", "out-of-order", "late-start"), "edge"),
    (("edge-stopped", "nan-transform"), ("gap",), "edge"),
    (("zero-stamp",), ("frozen-stamp", "single-sample"), "edge"),
    (("cache-short",), ("stale-stamp",), "stream"),
    (("frozen-stamp",), ("stale-stamp",), "edge"),
    (("parent-switch",), ("edge-stopped",), "edge"),
)
"""Which findings explain which, where they share the edge, child, frame, or way to the sensor.

"anything" needs nothing in common; "stream" an edge or a topic; "path" an edge of the way
or the topic.
"""
