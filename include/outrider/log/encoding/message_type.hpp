// MessageType: the fields of a message, listed once. Every encoding of a message and the text of its schema
// are made from this list (codecs.hpp).
//
// A message is a plain struct with the static members `type`, its ROS 2 name, and `describe()`, which lists
// its fields in the order of the ROS definition by list.field(name, member, unit) and its constants. The
// macro OUTRIDER_MESSAGE writes both (message_fields.hpp).
//
// A field is a bool, an integer, a floating-point number, a text, a message, or a std::vector or std::array
// of these (except bool).
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace outrider {

enum class FieldKind {
  boolean,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  text,
  message
};

enum class FieldShape { single, array, sequence };

struct MessageType;

/// A field of a message, with the functions that reach it in the struct.
struct MessageField {
  std::string_view name;
  std::string_view unit;  ///< such as "m"; empty if it has none
  FieldKind kind = FieldKind::float64;
  FieldShape shape = FieldShape::single;
  std::size_t array_length = 1;  ///< of an array
  std::size_t element_bytes =
      0;  ///< size of an element in the struct; that of a number is its size in the encodings, too
  const MessageType* message = nullptr;  ///< type of the elements, if these are messages
  std::string_view default_text = {};    ///< default value in the schema, as geometry_msgs/Quaternion has it
  std::size_t offset = 0;                ///< from the start of the struct

  /// Functions of a sequence: its length, its elements, and a change of its length.
  std::size_t (*length)(const void* field) = nullptr;
  const void* (*elements)(const void* field) = nullptr;
  void* (*resize)(void* field, std::size_t length) = nullptr;  ///< returns the elements
};

/// A constant of a ROS definition.
struct MessageConstant {
  std::string_view type;
  std::string_view name;
  int value = 0;
};

struct MessageType {
  std::string_view name;  ///< ROS 2 name, such as "sensor_msgs/msg/LaserScan"
  std::vector<MessageField> fields = {};
  std::vector<MessageConstant> constants = {};
  std::shared_ptr<void> (*make)() = nullptr;  ///< makes a message with its default values
};

/// Returns the description of a message type. The first call makes it.
template <class Message>
const MessageType& message_type();

namespace detail {

template <class T>
concept Sequence = std::same_as<T, std::vector<typename T::value_type>>;
template <class T>
concept FixedArray = std::same_as<T, std::array<typename T::value_type, std::tuple_size<T>::value>>;

template <class T>
constexpr FieldKind kind_of() {
  if constexpr (std::is_same_v<T, bool>)
    return FieldKind::boolean;
  else if constexpr (std::is_same_v<T, std::int8_t>)
    return FieldKind::int8;
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return FieldKind::uint8;
  else if constexpr (std::is_same_v<T, std::int16_t>)
    return FieldKind::int16;
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return FieldKind::uint16;
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return FieldKind::int32;
  else if constexpr (std::is_same_v<T, std::uint32_t>)
    return FieldKind::uint32;
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return FieldKind::int64;
  else if constexpr (std::is_same_v<T, std::uint64_t>)
    return FieldKind::uint64;
  else if constexpr (std::is_same_v<T, float>)
    return FieldKind::float32;
  else if constexpr (std::is_same_v<T, double>)
    return FieldKind::float64;
  else if constexpr (std::is_same_v<T, std::string>)
    return FieldKind::text;
  else
    return FieldKind::message;
}

/// Collects the fields that describe() lists.
template <class Message>
class FieldList {
 public:
  explicit FieldList(MessageType& type) : type_(type) {}

  template <class T>
  void field(std::string_view name, T Message::* member, std::string_view unit = {},
             std::string_view default_text = {}) {
    MessageField field;
    field.name = name;
    field.unit = unit;
    field.default_text = default_text;
    field.offset = static_cast<std::size_t>(reinterpret_cast<const char*>(&(sample_.*member)) -
                                            reinterpret_cast<const char*>(&sample_));
    if constexpr (Sequence<T>) {
      using Element = typename T::value_type;
      static_assert(!std::is_same_v<Element, bool>);
      set_element<Element>(field);
      field.shape = FieldShape::sequence;
      field.length = [](const void* at) { return static_cast<const T*>(at)->size(); };
      field.elements = [](const void* at) -> const void* { return static_cast<const T*>(at)->data(); };
      field.resize = [](void* at, std::size_t length) -> void* {
        static_cast<T*>(at)->resize(length);
        return static_cast<T*>(at)->data();
      };
    } else if constexpr (FixedArray<T>) {
      set_element<typename T::value_type>(field);
      field.shape = FieldShape::array;
      field.array_length = std::tuple_size_v<T>;
    } else {
      set_element<T>(field);
    }
    type_.fields.push_back(field);
  }

  void constant(std::string_view type, std::string_view name, int value) {
    type_.constants.push_back({type, name, value});
  }

 private:
  template <class Element>
  static void set_element(MessageField& field) {
    field.kind = kind_of<Element>();
    field.element_bytes = sizeof(Element);
    if constexpr (kind_of<Element>() == FieldKind::message) field.message = &message_type<Element>();
  }

  MessageType& type_;
  Message sample_{};
};

}  // namespace detail

template <class Message>
const MessageType& message_type() {
  static const MessageType made = [] {
    MessageType type{Message::type};
    detail::FieldList<Message> list(type);
    Message::describe(list);
    type.make = [] { return std::shared_ptr<void>(std::make_shared<Message>()); };
    return type;
  }();
  return made;
}

}  // namespace outrider
