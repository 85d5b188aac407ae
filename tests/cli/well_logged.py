"""The checks of a log that each run of a scenario passes: order, stamps, what stands still, the end, and the bounds."""
import json
import math

from mcap_log import McapLog

# Topics with messages at time 0 only. /run of the job slam comes again in the end, with the bounds.
STILL = {"/solids", "/terrain", "/walls", "/scene", "/footprint", "/supplies", "/tags", "/tf_static", "/camera/camera_info",
         "/cost_grid", "/costmap", "/expanded", "/initialpose"}
IN_BETWEEN = {"/target_positions", "/targets"}  # known only after the step in which they lie


def stamps(kind, message):
    """The stamps of a message that must be the time at which it is logged, as (seconds, nanoseconds)."""
    if kind == "rcl_interfaces/msg/Log":
        return [message["stamp"]]
    if kind == "tf2_msgs/msg/TFMessage":
        return [one["header"]["stamp"] for one in message["transforms"]]
    if kind == "visualization_msgs/msg/MarkerArray":
        return [one["header"]["stamp"] for one in message["markers"]]
    if kind == "outrider_msgs/msg/FiringRegion":
        return [message["grid"]["header"]["stamp"]]
    return [message["header"]["stamp"]] if "header" in message else []


def places(topic, message):
    """Positions of what is drawn of a message."""
    if topic.endswith("/pose") or topic in ("/target_pose", "/goal_pose"):
        return [message["pose"]["position"]]
    if topic.endswith("/trajectory") or topic.startswith("/plan"):
        return [pose["pose"]["position"] for pose in message["poses"]]
    if topic == "/target_positions":
        return [message["centre"]]
    if topic == "/supplies":
        return [station["position"] for station in message["stations"]]
    if topic == "/tags":
        return [tag["position"] for tag in message["tags"]]
    if topic == "/waypoints":
        return [waypoint["position"] for waypoint in message["waypoints"]]
    return []


def well_logged(test, folder, leaks=False):
    """Checks the log of a run that lies in this folder of the test."""
    log = McapLog((test.folder / folder / "run.mcap").read_bytes())
    test.assertTrue(log.complete)
    result = test.run_tool("convert", f"{folder}/run.mcap", "run.jsonl")
    test.assertEqual(result.returncode, 0, result.stderr)
    with open(test.folder / "run.jsonl", encoding="utf-8") as text:
        lines = [json.loads(line) for line in text]
    times = [message.time_ns for message in log.messages if message.topic not in IN_BETWEEN]
    test.assertEqual(times, sorted(times), "the file is in the order of time")
    for topic in IN_BETWEEN:
        own = [message.time_ns for message in log.messages if message.topic == topic]
        test.assertEqual(own, sorted(own), topic)
    test.assertEqual(times[0], 0)
    topics = {line["topic"] for line in lines}
    test.assertIn("/run", topics)
    moving = [message.time_ns for message in log.messages if message.topic in ("/pose", "/belief")]
    test.assertEqual(max(times), max(moving, default=0), "nothing is beyond the end of the run")
    info = [line["message"] for line in lines if line["topic"] == "/run"][-1]
    radius = info["robot_radius"] if isinstance(info["robot_radius"], float) else 0.0
    room = radius + 1e-6
    for line in lines:
        where = (line["topic"], line["time_ns"])
        for stamp in stamps(line["type"], line["message"]):
            test.assertEqual(stamp["sec"] * 10**9 + stamp["nanosec"], line["time_ns"], where)
        if line["topic"] in STILL:
            test.assertEqual(line["time_ns"], 0, where)
        if leaks:
            continue  # the robot drives into the endless world behind the gate
        for place in places(line["topic"], line["message"]):
            for axis in "xy":
                test.assertTrue(math.isfinite(place[axis]), where)
                test.assertGreaterEqual(place[axis], info["low"][axis] - room, where)
                test.assertLessEqual(place[axis], info["high"][axis] + room, where)
    if "/solids" in topics or "/walls" in topics:
        test.assertIn("/scene", topics)
