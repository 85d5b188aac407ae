// A process that is confined to a folder opens nothing outside of it, whatever scenario, world, model and map
// lie inside. The witness is the kernel, by inotify, which knows nothing of how we open files. An input is
// the four files, with lines "====" between them; @OUT@ stands for the absolute path of the folder outside.
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/files/confinement.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/io/sdf/sdf.hpp"
#include "outrider/jobs/catalog.hpp"

namespace {

namespace fs = std::filesystem;

constexpr const char* wall =
    "<sdf version='1.6'><model name='wall'><link name='l'><collision name='c'><geometry><box><size>1 1 "
    "1</size>"
    "</box></geometry></collision></link></model></sdf>";
constexpr std::array<const char*, 4> inputs = {"scenario.yaml", "world.sdf", "tree/model.config", "map.yaml"};

/// Two folders side by side. The process is confined to `inside`; every opening of something in `outside` is
/// seen.
class Folders {
 public:
  Folders() {
    std::string name = (fs::temp_directory_path() / "outrider_fuzz_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    root_ = name;
    for (const char* folder : {"inside/", "outside/", "outside/deep/"}) {
      write(std::string(folder) + "targets.txt", "name=fox type=1 x=1 y=1\n");
      write(std::string(folder) + "map.pgm", "P2 2 2 255 0 254 254 0\n");
      write(std::string(folder) + "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
      write(std::string(folder) + "wall.sdf", wall);
      write(std::string(folder) + "tree/model.sdf", wall);
      write(std::string(folder) + "tree/model.config", "<model><sdf>model.sdf</sdf></model>");
    }
    fs::create_directory_symlink("../outside", root_ / "inside/link_folder");
    for (const char* file : {"targets.txt", "map.pgm", "mesh.obj", "wall.sdf"}) {
      fs::create_symlink("../outside/" + std::string(file), root_ / "inside" / ("link_" + std::string(file)));
    }
    watch();
    if (!outrider::confine_reading((root_ / "inside").string())) std::abort();
  }
  Folders(const Folders&) = delete;
  Folders& operator=(const Folders&) = delete;
  ~Folders() {
    ::close(witness_);
    fs::remove_all(root_);
  }

  void write(const std::string& name, std::string text) const {
    const std::string out = (root_ / "outside").string();
    for (std::size_t at = 0; (at = text.find("@OUT@", at)) != std::string::npos; at += out.size()) {
      text.replace(at, 5, out);
    }
    fs::create_directories((root_ / name).parent_path());
    fs::remove(root_ / name);  // some file systems flush what is truncated
    std::ofstream(root_ / name, std::ios::binary) << text;
  }

  /// True if something outside was opened or read since the last call.
  bool opened_outside() const {
    bool any = false;
    alignas(inotify_event) std::array<char, 4096> events{};
    while (::read(witness_, events.data(), events.size()) > 0) {
      const auto* event = reinterpret_cast<const inotify_event*>(events.data());
      std::fprintf(stderr, "opened outside: %s\n", event->len > 0 ? event->name : "the folder itself");
      any = true;
    }
    return any;
  }

 private:
  /// Watches `outside` and all folders in it, and makes sure that the witness sees.
  void watch() {
    witness_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    for (const char* folder : {"outside", "outside/tree", "outside/deep", "outside/deep/tree"}) {
      if (::inotify_add_watch(witness_, (root_ / folder).c_str(), IN_OPEN | IN_ACCESS) < 0) std::abort();
    }
    std::ifstream(root_ / "outside/tree/model.sdf").get();
    std::array<char, 4096> events{};
    if (::read(witness_, events.data(), events.size()) <= 0) std::abort();
  }

  fs::path root_;
  int witness_ = -1;
};

void load_everything() {
  using namespace outrider;
  for (const Job& job : jobs()) {
    const auto task = job.blank();
    if (read_scenario(*task, "scenario.yaml")) static_cast<void>(task->load());
  }
  static_cast<void>(load_sdf("world.sdf"));
  static_cast<void>(load_map_server("map.yaml"));
}

}  // namespace

extern "C" int FUZZ_ENTRY(confinement)(const std::uint8_t* data, std::size_t size) {
  static const Folders folders;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  for (const char* name : inputs) {
    constexpr std::string_view separator = "\n====\n";
    const std::size_t end = rest.find(separator);
    folders.write(std::string("inside/") + name, std::string(rest.substr(0, end)));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + separator.size());
  }
  load_everything();
  if (folders.opened_outside()) std::abort();
  return 0;
}
