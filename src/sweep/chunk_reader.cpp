#include "outrider/sweep/chunk_reader.hpp"

#include "outrider/io/files/files.hpp"
#include "outrider/sweep/manifest.hpp"

namespace outrider {

Status ChunkReader::for_each_text(
    const std::function<Status(std::uint64_t chunk, const ChunkText& text, const std::string& path)>& use) {
  const auto manifest = manifest_in(folder_);
  if (!manifest) return pass_on(manifest);
  const std::string origin = manifest_hash(*manifest);
  for (std::uint64_t chunk = 0; chunk < sweep_->chunks(); ++chunk) {
    const std::string path = chunk_path(folder_, chunk);
    const auto text = read_file(path);
    if (!text) return pass_on(text);
    if (!checked_[chunk]) {
      if (auto ok = check_chunk(*sweep_, chunk, origin, *text, path); !ok) return ok;
      checked_[chunk] = true;
    }
    const auto split = split_chunk(*sweep_, chunk, *text, path);
    if (!split) return pass_on(split);
    if (auto ok = use(chunk, *split, path); !ok) return ok;
  }
  return {};
}

Status ChunkReader::for_each_table(const std::function<void(const SweepTable&)>& use) {
  return for_each_text([&](std::uint64_t chunk, const ChunkText& text, const std::string& path) -> Status {
    const auto table = read_rows(*sweep_, chunk, text, path);
    if (!table) return pass_on(table);
    use(*table);
    return {};
  });
}

}  // namespace outrider
