// The folder of the server targets: it has a yard, and an App that starts no mission.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app.hpp"
#include "files/temporary_folder.hpp"
#include "outrider/io/files/confinement.hpp"
#include "outrider/jobs/catalog.hpp"

namespace outrider::fuzzing {

/// Lies beside the folder that is served; no answer may hold it.
inline constexpr std::string_view secret = "name=sesame_of_the_outside";

class ServedYard {
 public:
  /// Confines this process as `outrider serve` confines those that read for it; temporary folders lie within.
  ServedYard() : home_(must(server::TemporaryFolder::make())) {
    write("secret.txt", std::string(secret));
    std::filesystem::create_directories(home_.path() / "inside/temporary");
    ::setenv("TMPDIR", (home_.path() / "inside/temporary").c_str(), 1);
    reset();
    if (!confine_reading((home_.path() / "inside").string())) std::abort();
  }

  /// The folder as it was at first, without what requests wrote.
  void reset() {
    namespace fs = std::filesystem;
    for (const auto& entry : fs::directory_iterator(home_.path() / "inside")) {
      if (entry.path().filename() != "temporary") fs::remove_all(entry.path());
    }
    write("inside/yard.sdf",
          "<sdf version='1.6'><world name='w'><model name='floor'><link name='l'><collision name='c'>"
          "<geometry><plane><normal>0 0 1</normal><size>9 9</size></plane></geometry></collision></link>"
          "</model><model name='post'><pose>1 1 0.5 0 0 0</pose><link name='l'><collision name='c'>"
          "<geometry><box><size>0.4 0.4 1</size></box></geometry></collision></link></model></world></sdf>");
    write("inside/yard.yaml",
          "job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nbounds: -4,-4,4,4\n");
    write("inside/targets.txt", "name=fox type=1 x=2 y=2\n");
    write("inside/room.map", "type octile\nheight 2\nwidth 3\nmap\n.@T\nGSW\n");
    write("inside/.outrider", "a file, so that no run is kept for the next input");
    fs::create_symlink("../secret.txt", home_.path() / "inside/link.txt");
  }

  /// A new one for every input, so that it is the input alone that matters.
  [[nodiscard]] server::App app() const {
    server::AppSettings settings{"1", "", jobs(), {}, {}, read_here};
    settings.runs.at_once = 0;
    settings.runs.waiting = 4;
    return {must(server::Folder::open((home_.path() / "inside").string())), settings};
  }

 private:
  /// Files that were sent lie in a folder beneath the one that this process may read.
  static Outcome<server::Json> read_here(const server::Folder& folder, const server::Json& question,
                                         const std::stop_token&) {
    server::Json asked = question;
    const std::size_t sent = folder.path().find("temporary/");
    if (sent != std::string::npos && asked.contains("map"))
      asked["map"] = folder.path().substr(sent) + "/" + asked["map"].get<std::string>();
    return server::answer_reading(asked, folder, jobs());
  }

  template <class T>
  static T must(Outcome<T> outcome) {
    if (outcome) return std::move(*outcome);
    std::fprintf(stderr, "the target has no folder: %s\n", to_string(outcome.error()).c_str());
    std::abort();
  }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((home_.path() / name).parent_path());
    std::ofstream(home_.path() / name, std::ios::binary) << text;
  }

  server::TemporaryFolder home_;
};

}  // namespace outrider::fuzzing
