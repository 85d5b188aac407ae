#include "log.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "faults.hpp"
#include "options.hpp"
#include "outrider/io/log/log_file.hpp"
#include "outrider/log/messages/known_messages.hpp"
#include "outrider/log/numpy.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

/// Collects the messages of known types.
class Arrays final : public LogSink {
 public:
  void add_channel(const Channel& channel) override {
    channels_.push_back(channel);
    messages_.push_back(value_of(AnyMessage::of(channel)));
  }
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override {
    std::optional<AnyMessage>& message = messages_[channel];
    if (!message) return;
    require(message->decode(data));
    require(arrays_.append(channels_[channel].topic, time_ns, message->type(), message->content()));
  }
  std::vector<NumpyArray> finish() { return value_of(arrays_.finish()); }

 private:
  std::vector<Channel> channels_;
  std::vector<std::optional<AnyMessage>> messages_;
  NumpyArrays arrays_;
};

py::dict loaded(const std::vector<NumpyArray>& arrays) {
  const py::object load = py::module_::import("numpy").attr("load");
  const py::object bytes_io = py::module_::import("io").attr("BytesIO");
  py::dict result;
  for (const NumpyArray& array : arrays) result[py::str(array.name)] = load(bytes_io(py::bytes(array.bytes)));
  return result;
}

}  // namespace

py::dict arrays_of(Log& log) {
  Arrays arrays;
  log.add_sink(arrays);
  log.remove_sink(arrays);
  return loaded(arrays.finish());
}

void bind_log(py::module_& module) {
  module.def(
      "read_log",
      [](const py::handle& at, std::vector<std::string> topics) {
        const std::string path = path_text(at);
        std::vector<NumpyArray> made;
        std::string cut_short;
        {
          const py::gil_scoped_release others_may_run;
          const auto reader = value_of(open_log_file(path, {.topics = std::move(topics)}));
          Arrays arrays;
          for (const Channel& channel : reader->channels()) arrays.add_channel(channel);
          while (const std::optional<LogMessage> message = value_of(reader->next())) {
            arrays.append(message->channel, message->time_ns, message->data);
          }
          made = arrays.finish();
          cut_short = reader->cut_short();
        }
        if (!cut_short.empty() &&
            PyErr_WarnEx(PyExc_RuntimeWarning, (path + ": " + cut_short).c_str(), 1) != 0) {
          throw py::error_already_set();
        }
        return loaded(made);
      },
      py::arg("path"), py::kw_only(), py::arg("topics") = std::vector<std::string>());
}

}  // namespace outrider::python
