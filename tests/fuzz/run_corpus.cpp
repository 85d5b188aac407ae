// Fuzz targets without libFuzzer:
//
//     fuzz_corpus NAME FOLDER      runs a target over every file of a folder; fails when there is none
//     fuzz_corpus --complete HERE  every HERE/*_fuzz.cpp is a target with seeds in HERE/corpus, and no
//                                  other seeds lie there
//
// A target ends the program (abort) on an input that breaks what it promises.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#define FUZZ_TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef FUZZ_TARGET

namespace {

namespace fs = std::filesystem;
using Target = int (*)(const std::uint8_t*, std::size_t);

const std::map<std::string, Target>& targets() {
  static const std::map<std::string, Target> all = {
#define FUZZ_TARGET(name) {#name, &fuzz_##name},
#include "fuzz_targets.inc"
#undef FUZZ_TARGET
  };
  return all;
}

std::size_t files_in(const fs::path& folder) {
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  return error ? 0 : static_cast<std::size_t>(std::distance(fs::begin(entries), fs::end(entries)));
}

int complain(const std::string& sentence) {
  std::fprintf(stderr, "fuzz_corpus: %s\n", sentence.c_str());
  return 1;
}

int run(const std::string& name, const fs::path& folder) {
  const auto target = targets().find(name);
  if (target == targets().end()) return complain("there is no target " + name);
  if (files_in(folder) == 0) return complain("there is no seed in " + folder.string());
  std::set<fs::path> seeds;
  for (const auto& entry : fs::directory_iterator(folder)) seeds.insert(entry.path());
  for (const fs::path& seed : seeds) {
    std::ifstream file(seed, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::printf("%s: %zu bytes\n", seed.filename().c_str(), bytes.size());
    std::fflush(stdout);  // names the input that ends the program
    target->second(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%s: %zu inputs executed\n", name.c_str(), seeds.size());
  return 0;
}

int check_complete(const fs::path& here) {
  std::set<std::string> written;
  for (const auto& entry : fs::directory_iterator(here)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with("_fuzz.cpp")) written.insert(file.substr(0, file.size() - 9));
  }
  if (written.empty()) return complain("there is no target in " + here.string());
  for (const std::string& name : written) {
    if (!targets().contains(name)) return complain(name + "_fuzz.cpp is not in this program");
    if (files_in(here / "corpus" / name) == 0) return complain(name + " has no seed in corpus/" + name);
  }
  for (const auto& entry : fs::directory_iterator(here / "corpus")) {
    const std::string name = entry.path().filename().string();
    if (!written.contains(name)) return complain("corpus/" + name + " belongs to no target");
  }
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return complain("expected NAME FOLDER, or --complete FOLDER");
  return words[1] == std::string("--complete") ? check_complete(words[2]) : run(words[1], words[2]);
}
