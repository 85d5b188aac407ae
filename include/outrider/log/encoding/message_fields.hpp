// OUTRIDER_MESSAGE: says once what a message is, in its struct, after its members: the struct, its ROS 2
// name, and its fields in the order of the ROS definition, those with a unit as a pair:
//
//   struct Point {
//     double x = 0.0, y = 0.0;
//     OUTRIDER_MESSAGE(Point, "geometry_msgs/msg/Point", (x, "m"), (y, "m"))
//   };
//
// It defines the static members `type` and `describe()` of message_type.hpp. Messages with constants, or
// whose members are named otherwise than their fields, define these by hand. At most 64 fields.
#pragma once

#include <string_view>

#define OUTRIDER_MESSAGE(message, ros_name, ...)                  \
  static constexpr std::string_view type = ros_name;              \
  template <class List>                                           \
  static void describe(List& list) {                              \
    OUTRIDER_REPEAT_64(OUTRIDER_EACH_FIELD(message, __VA_ARGS__)) \
  }

// The first field, then this macro again for the others: under a name that the next round of expansion
// completes.
#define OUTRIDER_EACH_FIELD(message, first, ...) \
  OUTRIDER_FIELD(message, first) __VA_OPT__(OUTRIDER_OTHER_FIELDS OUTRIDER_NO_ARGUMENTS(message, __VA_ARGS__))
#define OUTRIDER_OTHER_FIELDS() OUTRIDER_EACH_FIELD
#define OUTRIDER_NO_ARGUMENTS ()
#define OUTRIDER_REPEAT_64(...) \
  OUTRIDER_REPEAT_16(OUTRIDER_REPEAT_16(OUTRIDER_REPEAT_16(OUTRIDER_REPEAT_16(__VA_ARGS__))))
#define OUTRIDER_REPEAT_16(...) \
  OUTRIDER_REPEAT_4(OUTRIDER_REPEAT_4(OUTRIDER_REPEAT_4(OUTRIDER_REPEAT_4(__VA_ARGS__))))
#define OUTRIDER_REPEAT_4(...) OUTRIDER_ONCE(OUTRIDER_ONCE(OUTRIDER_ONCE(OUTRIDER_ONCE(__VA_ARGS__))))
#define OUTRIDER_ONCE(...) __VA_ARGS__

// A field is a name or a pair; a name that follows OUTRIDER_PAIR leaves it unexpanded.
#define OUTRIDER_FIELD(message, field) \
  OUTRIDER_CALL(OUTRIDER_JOIN, OUTRIDER_FIELD_, OUTRIDER_IS_PAIR(field))(message, field)
#define OUTRIDER_FIELD_0(message, name) list.field(#name, &message::name);
#define OUTRIDER_FIELD_1(message, pair) OUTRIDER_CALL(OUTRIDER_FIELD_IN, message, OUTRIDER_BARE pair)
#define OUTRIDER_FIELD_IN(message, name, unit) list.field(#name, &message::name, unit);
#define OUTRIDER_IS_PAIR(field) OUTRIDER_CALL(OUTRIDER_SECOND, OUTRIDER_PAIR field, 0, )
#define OUTRIDER_PAIR(...) , 1
#define OUTRIDER_SECOND(first, second, ...) second
#define OUTRIDER_BARE(...) __VA_ARGS__
#define OUTRIDER_JOIN(left, right) left##right
#define OUTRIDER_CALL(macro, ...) macro(__VA_ARGS__)
