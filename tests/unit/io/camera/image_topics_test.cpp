#include "outrider/io/camera/image_topics.hpp"

#include <gtest/gtest.h>

#include "outrider/io/camera/photo.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "support/data.hpp"
#include "support/robot_logs.hpp"

namespace outrider {
namespace {

using test::RobotMessages;

sensor_msgs::Image image_of(const std::string& encoding, std::vector<std::uint8_t> data, std::uint32_t width,
                            std::uint32_t height = 1) {
  sensor_msgs::Image image;
  image.header = header_of(2.5, "camera");
  image.encoding = encoding;
  image.width = width;
  image.height = height;
  image.step = static_cast<std::uint32_t>(data.size()) / height;
  image.data = std::move(data);
  return image;
}

sensor_msgs::CameraInfo camera_info() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.d = {0.1, -0.2, 0.001, 0.002, 0.05};
  info.k = {500.0, 0.0, 320.0, 0.0, 501.0, 240.0, 0.0, 0.0, 1.0};
  return info;
}

std::vector<std::uint8_t> grey_of(const sensor_msgs::Image& image) {
  const auto grey = grey_image(image);
  EXPECT_TRUE(grey) << grey.error().sentence;
  return grey ? grey->values : std::vector<std::uint8_t>{};
}

TEST(GreyImage, EveryEncodingIsTheLuminance) {
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(grey_of(image_of("mono8", {7, 255}, 2)), (Bytes{7, 255}));
  EXPECT_EQ(grey_of(image_of("rgb8", {255, 0, 0, 0, 255, 0}, 2)), (Bytes{76, 150}));
  EXPECT_EQ(grey_of(image_of("bgr8", {0, 0, 255, 0, 255, 0}, 2)), (Bytes{76, 150}));
  EXPECT_EQ(grey_of(image_of("bgra8", {255, 0, 0, 9, 9, 9, 9, 0}, 2)), (Bytes{29, 9}));
  EXPECT_EQ(grey_of(image_of("rgba8", {255, 255, 255, 0}, 1)), (Bytes{255}));
  EXPECT_EQ(grey_of(image_of("mono16", {1, 200, 2, 100}, 2)), (Bytes{200, 100}))
      << "the upper byte is the second";
  auto big = image_of("mono16", {200, 1}, 1);
  big.is_bigendian = 1;
  EXPECT_EQ(grey_of(big), (Bytes{200}));
  EXPECT_EQ(grey_of(image_of("uyvy", {9, 1, 9, 2}, 2)), (Bytes{1, 2}));
  EXPECT_EQ(grey_of(image_of("yuyv", {1, 9, 2, 9}, 2)), (Bytes{1, 2}));
  EXPECT_EQ(grey_of(image_of("mono8", {1, 2, 0, 3, 4, 0}, 2, 2)), (Bytes{1, 2, 3, 4})) << "rows have a rest";
}

TEST(GreyImage, SizesThatDoNotAgreeAreRefused) {
  const auto fault_of = [](const sensor_msgs::Image& image) { return grey_image(image).error().sentence; };
  EXPECT_NE(fault_of(image_of("bayer_rggb8", {1}, 1)).find("images in 'bayer_rggb8' are not read"),
            std::string::npos);
  EXPECT_NE(fault_of(image_of("rgb8", {1, 2}, 1)).find("where rows take 3 or more"), std::string::npos);
  auto huge = image_of("mono8", {1}, 100'000, 1);
  huge.height = 100'000;
  EXPECT_NE(fault_of(huge).find("100000 x 100000 pixels is not read"), std::string::npos);
  huge.height = 0;
  EXPECT_NE(fault_of(huge).find("is not read"), std::string::npos);
  auto cut = image_of("mono8", {1, 2, 3, 4}, 2, 2);
  cut.data.pop_back();
  EXPECT_NE(fault_of(cut).find("with 3 bytes in mono8"), std::string::npos);
}

TEST(CameraOf, IsThatOfTheMessage) {
  const auto camera = camera_of(camera_info());
  ASSERT_TRUE(camera) << camera.error().sentence;
  EXPECT_EQ(camera->fy, 501.0);
  EXPECT_EQ(camera->cx, 320.0);
  EXPECT_EQ(camera->distortion[4], 0.05);
  EXPECT_EQ(camera->width_px, 640);
  auto fisheye = camera_info();
  fisheye.distortion_model = "equidistant";
  EXPECT_NE(camera_of(fisheye).error().sentence.find("'equidistant' with 5 numbers is not known"),
            std::string::npos);
  auto skewed = camera_info();
  skewed.k[1] = 1.0;
  EXPECT_FALSE(camera_of(skewed));
  EXPECT_FALSE(camera_of({}));
}

TEST(ImageTopics, ImagesOfALogComeWithTheirCamera) {
  const test::Folder folder;
  RobotMessages log;
  log.add("/other/camera_info", 0.0, sensor_msgs::CameraInfo{});
  log.add("/camera/camera_info", 0.0, camera_info());
  log.add("/camera/image_raw", 1.0, image_of("mono8", {1, 2}, 2));
  log.add("/camera/image_raw", 2.0, image_of("mono8", {3, 4}, 2));
  for (const std::string& bytes : {log.mcap(), log.mcap(MessageEncoding::json), log.bag("lz4"), log.db3()}) {
    auto images = ImageTopics::open(folder.write("log", bytes), {});
    ASSERT_TRUE(images) << to_string(images.error());
    ASSERT_TRUE(images->camera());
    EXPECT_EQ(images->camera()->fx, 500.0);
    const auto first = images->next();
    ASSERT_TRUE(first && *first);
    EXPECT_EQ((*first)->time_s, 2.5);
    EXPECT_EQ((*first)->image.values, (std::vector<std::uint8_t>{1, 2}));
    EXPECT_TRUE(images->next());
    const auto end = images->next();
    ASSERT_TRUE(end);
    EXPECT_FALSE(*end);
  }
}

TEST(ImageTopics, CompressedImagesAreRead) {
  const test::Folder folder;
  const std::string png = to_png({2, 1, {10, 20}});
  RobotMessages log;
  log.add("/camera/image_raw/compressed", 1.0,
          sensor_msgs::CompressedImage{header_of(1.0, "camera"), "png", {png.begin(), png.end()}});
  log.add("/camera/image_raw/compressed", 2.0,
          sensor_msgs::CompressedImage{header_of(2.0, "camera"), "jpeg", {1, 2}});
  auto images = ImageTopics::open(folder.write("log", log.mcap()), {});
  ASSERT_TRUE(images) << to_string(images.error());
  EXPECT_FALSE(images->camera());
  const auto first = images->next();
  ASSERT_TRUE(first && *first);
  EXPECT_EQ((*first)->image.values, (std::vector<std::uint8_t>{10, 20}));
  const auto damaged = images->next();
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().where, "/camera/image_raw/compressed");
}

TEST(ImageTopics, SeveralTopicsAreNamedInTheRefusal) {
  const test::Folder folder;
  RobotMessages log;
  log.add("/left/image", 1.0, image_of("mono8", {1}, 1));
  log.add("/right/image", 1.0, image_of("mono8", {1}, 1));
  const std::string path = folder.write("log", log.mcap());
  const auto several = ImageTopics::open(path, {});
  ASSERT_FALSE(several);
  EXPECT_NE(to_string(several.error()).find("--image-topic: the log has several topics"), std::string::npos);
  EXPECT_TRUE(ImageTopics::open(path, {.image = "/left/image"}));
  const auto none = ImageTopics::open(path, {.image = "/left/image", .info = "/left/camera_info"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().where, "--info-topic");
}

}  // namespace
}  // namespace outrider
