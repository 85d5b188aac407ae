// The file of a small robot with two sensors.
#pragma once

#include <string>

namespace outrider::test {

/// A disk of 0.3 m about base_link and 0.4 m high, whose mast has a laser at 0.1 m ahead and 0.5 m above the
/// floor, turned left by 90 degrees; camera_link looks ahead 0.2 m in front of the middle, 0.25 m above the
/// floor.
inline const std::string cart_urdf =
    "<robot name='cart'><link name='base_link'><collision><origin xyz='0 0 0.2'/><geometry><cylinder "
    "radius='0.3' "
    "length='0.4'/></geometry></collision></link><link name='laser'/><link name='camera_link'/><link "
    "name='tilted'/>"
    "<joint name='a' type='fixed'><parent link='base_link'/><child link='laser'/><origin xyz='0.1 0 0.5' "
    "rpy='0 0 "
    "1.5707963267948966'/></joint><joint name='b' type='fixed'><parent link='base_link'/><child "
    "link='camera_link'/>"
    "<origin xyz='0.2 0 0.25'/></joint><joint name='c' type='fixed'><parent link='base_link'/><child "
    "link='tilted'/>"
    "<origin rpy='0 0.7 0'/></joint></robot>\n";

}  // namespace outrider::test
