#include "live/live.hpp"

#include <nlohmann/json.hpp>

#include "http/message.hpp"
#include "live/foxglove_viewer.hpp"
#include "live/page_viewer.hpp"

namespace outrider::server {

Live::Live(Runs& runs, Shared& shared, std::string version)
    : runs_(runs), shared_(shared), version_(std::move(version)), register_(std::make_shared<Register>()) {
  runs_.on_change([known = register_] {
    std::vector<std::shared_ptr<Viewer>> viewers;
    {
      const std::lock_guard lock(known->mutex);
      for (const auto& viewer : known->viewers) viewers.push_back(viewer.lock());
    }
    for (const auto& viewer : viewers) {
      if (viewer) viewer->wake();
    }
  });
}

Live::~Live() {
  runs_.on_change({});
  close();
}

std::shared_ptr<Viewer> Live::open() {
  const std::string hello = text_of(Json{{"type", "hello"}, {"api", 1}, {"version", version_}});
  return enter(std::make_shared<PageViewer>(runs_, shared_, hello));
}

std::shared_ptr<Viewer> Live::open_foxglove(const std::string& run) {
  return enter(std::make_shared<FoxgloveViewer>(runs_, shared_, version_, run));
}

std::shared_ptr<Viewer> Live::enter(std::shared_ptr<Viewer> viewer) {
  const std::lock_guard lock(register_->mutex);
  std::erase_if(register_->viewers, [](const auto& other) { return other.expired(); });
  register_->viewers.push_back(viewer);
  if (register_->closed) viewer->close();
  return viewer;
}

void Live::close() {
  std::vector<std::weak_ptr<Viewer>> viewers;
  {
    const std::lock_guard lock(register_->mutex);
    register_->closed = true;
    viewers = register_->viewers;
  }
  for (const auto& viewer : viewers) {
    if (const auto one = viewer.lock()) one->close();
  }
}

}  // namespace outrider::server
