#include "outrider/io/files/read_record.hpp"

#include <gtest/gtest.h>

#include "outrider/io/files/files.hpp"

namespace outrider {
namespace {

const std::string yard = OUTRIDER_SOURCE_DIR "/scenarios/yard/";

TEST(ReadRecord, NotesWhatIsReadWhileItLives) {
  (void)read_file(yard + "targets.txt");
  const ReadRecord record;
  EXPECT_TRUE(record.paths().empty());
  (void)read_file(yard + "yard.yaml");
  (void)read_file(yard + "none.txt");
  EXPECT_EQ(record.paths(), (std::set<std::string>{yard + "none.txt", yard + "yard.yaml"}));
}

}  // namespace
}  // namespace outrider
