// McapReader: the messages of an MCAP file in the order of time.
//
// Chunks may overlap in time. A piece of the file is loaded when no message that is loaded already is earlier
// than it may begin, and let go after its last message: so only pieces that overlap are in memory together,
// at most 512 MiB of them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bytes/byte_source.hpp"
#include "formats.hpp"
#include "mcap/read/mcap_index.hpp"

namespace outrider {

namespace mcap {

class McapReader final : public LogReader {
 public:
  McapReader(std::unique_ptr<ByteSource> source, McapIndex index, const LogSelection& selection);

  [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
  Outcome<std::optional<LogMessage>> next() override;
  [[nodiscard]] std::string cut_short() const override { return index_.cut_short; }
  [[nodiscard]] double progress() const override {
    return index_.pieces.empty()
               ? 1.0
               : static_cast<double>(next_piece_) / static_cast<double>(index_.pieces.size());
  }

 private:
  struct Place {
    std::uint64_t time = 0;
    std::uint32_t channel = 0;
    std::uint32_t offset = 0;  // of the data, in the loaded bytes: a chunk has less than 4 GiB
    std::uint32_t length = 0;
  };
  struct Loaded {
    std::uint64_t file_offset = 0;
    std::string bytes;
    std::vector<Place> places;  // of the selected messages, in the order of time
    std::size_t next = 0;

    [[nodiscard]] std::uint64_t held() const { return bytes.size() + places.size() * sizeof(Place); }
  };

  [[nodiscard]] bool may_have_selected(const Piece& piece) const;
  void select(const LogSelection& selection);
  Status load_due();
  Outcome<Loaded> load(const Piece& piece) const;
  std::string find_places(const Piece& piece, Loaded& loaded) const;

  std::unique_ptr<ByteSource> source_;
  McapIndex index_;  // its pieces are the waiting ones, in the order in which they start
  std::vector<Channel> channels_;
  std::map<std::uint16_t, std::size_t> channel_of_id_;
  std::vector<char> selected_;  // by channel
  bool nothing_selected_ = false;
  std::uint64_t from_ = 0;
  std::uint64_t to_ = 0;
  std::size_t next_piece_ = 0;
  std::vector<std::unique_ptr<Loaded>> loaded_;  // a heap, the earliest message first
  std::unique_ptr<Loaded> current_;              // holds the message that next() returned
  std::uint64_t held_bytes_ = 0;
  Status state_;  // the first fault, which all further calls return
};

}  // namespace mcap
}  // namespace outrider
