#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/ply.h"

namespace yat {
namespace {

/// Bytes in a chosen order, whatever this machine's is.
class Bytes {
 public:
  explicit Bytes(std::endian order) : swap_(order != std::endian::native) {}
  template <class T>
  Bytes& add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (swap_) std::reverse(bytes, bytes + sizeof(T));
    text.append(bytes, sizeof(T));
    return *this;
  }
  std::string text;

 private:
  bool swap_;
};

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kTriangleElements =
    "element vertex 3\n" + kXyz + "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kTriangleBody = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string error_of(const std::string& data) {
  try {
    parse_ply(data, "m.ply");
  } catch (const PlyError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Ply, ReadsAscii) {
  const PlyMesh mesh = parse_ply(header("ascii", kTriangleElements) + kTriangleBody, "m.ply");
  EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_EQ(mesh.faces, 1u);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Ply, ReadsBothByteOrders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    Bytes body(order);
    for (float x : {0.f, 0.f, 0.f, 1.5f, 0.f, 0.f, 0.f, -2.25f, 0.f}) body.add(x);
    body.add<uint8_t>(3).add<int32_t>(2).add<int32_t>(0).add<int32_t>(1);
    const PlyMesh mesh = parse_ply(
        header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian",
               kTriangleElements) +
            body.text,
        "m.ply");
    EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, 0, 1.5f, 0, 0, 0, -2.25f, 0}));
    EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{2, 0, 1}));
  }
}

TEST(Ply, ReadsEveryScalarType) {
  // The same three vertices in each type; z carries the extreme that tells signed from unsigned.
  const auto with = [&]<class T>(const char* type, T extreme) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      Bytes body(order);
      for (int v = 0; v < 3; ++v) body.add(T(v == 1)).add(T(v == 2)).add(extreme);
      body.add<uint8_t>(3).add<int32_t>(0).add<int32_t>(1).add<int32_t>(2);
      const std::string t = type;
      const PlyMesh mesh = parse_ply(
          header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian",
                 "element vertex 3\nproperty " + t + " x\nproperty " + t + " y\nproperty " + t +
                     " z\nelement face 1\nproperty list uchar int vertex_indices\n") +
              body.text,
          "m.ply");
      const auto z = float(extreme);
      EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, z, 1, 0, z, 0, 1, z})) << type;
    }
  };
  with.operator()<int8_t>("char", -128);
  with.operator()<int8_t>("int8", -1);
  with.operator()<uint8_t>("uchar", 255);
  with.operator()<uint8_t>("uint8", 200);
  with.operator()<int16_t>("short", -32768);
  with.operator()<int16_t>("int16", -2);
  with.operator()<uint16_t>("ushort", 65535);
  with.operator()<uint16_t>("uint16", 40000);
  with.operator()<int32_t>("int", -70000);
  with.operator()<int32_t>("int32", -3);
  with.operator()<uint32_t>("uint", 4000000000u);
  with.operator()<uint32_t>("uint32", 7);
  with.operator()<float>("float", 0.1f);
  with.operator()<float>("float32", -0.1f);
  with.operator()<double>("double", 0.25);
  with.operator()<double>("float64", 1e300);
}

TEST(Ply, FindsNormalsAndUvsUnderAllTheirNames) {
  for (const auto& [s, t] : std::vector<std::pair<std::string, std::string>>{
           {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"u0", "v0"}}) {
    const PlyMesh mesh = parse_ply(
        header("ascii", "element vertex 3\nproperty uchar red\n" + kXyz +
                            "property float nx\nproperty float ny\nproperty float nz\nproperty "
                            "double " +
                            s + "\nproperty double " + t +
                            "\nelement face 1\nproperty list uchar int vertex_index\n") +
            "9 0 0 0 0 0 1 .1 .2\n9 1 0 0 0 0 2 .3 .4\n9 0 1 0 0 0 3 .5 .6\n3 0 1 2\n",
        "m.ply");
    EXPECT_EQ(mesh.normals, (std::vector<float>{0, 0, 1, 0, 0, 2, 0, 0, 3})) << s;
    EXPECT_EQ(mesh.uvs, (std::vector<float>{.1f, .2f, .3f, .4f, .5f, .6f})) << s;
    EXPECT_EQ(mesh.positions[3], 1);
  }
}

TEST(Ply, NormalsNeedAllThreeParts) {
  const PlyMesh mesh = parse_ply(
      header("ascii", "element vertex 3\n" + kXyz +
                          "property float nx\nproperty float ny\nelement face 1\nproperty list "
                          "uchar int vertex_indices\n") +
          "0 0 0 0 1\n1 0 0 0 1\n0 1 0 0 1\n3 0 1 2\n",
      "m.ply");
  EXPECT_TRUE(mesh.normals.empty());
}

TEST(Ply, SplitsQuadsAlongTheShorterDiagonal) {
  const auto quad = [](const std::string& vertices) {
    return parse_ply(header("ascii", "element vertex 4\n" + kXyz +
                                         "element face 1\nproperty list uchar int "
                                         "vertex_indices\n") +
                         vertices + "4 0 1 2 3\n",
                     "m.ply")
        .triangles;
  };
  EXPECT_EQ(quad("0 0 0\n2 0 0\n3 1 0\n1 1 0\n"), (std::vector<uint32_t>{0, 1, 3, 1, 2, 3}));
  EXPECT_EQ(quad("1 0 0\n3 0 0\n2 1 0\n0 1 0\n"), (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(quad("0 0 0\n1 0 0\n1 1 0\n0 1 0\n"), (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Ply, FacesMayComeBeforeVertices) {
  const PlyMesh mesh = parse_ply(
      header("ascii",
             "element face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n" + kXyz) +
          "4 0 1 2 3\n0 0 0\n2 0 0\n3 1 0\n1 1 0\n",
      "m.ply");
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 3, 1, 2, 3}));
}

TEST(Ply, PolygonsBecomeFansAndThinFacesAreLeftOut) {
  const PlyMesh mesh =
      parse_ply(header("ascii", "element vertex 5\n" + kXyz +
                                    "element face 3\nproperty list uchar int vertex_indices\n") +
                    "0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n2 0 1\n3 4 3 2\n",
                "m.ply");
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4, 4, 3, 2}));
  EXPECT_EQ(mesh.warnings,
            (std::vector<std::string>{
                "m.ply: 1 of 3 faces have more than 4 corners, split into fans (right for convex "
                "ones)",
                "m.ply: 1 of 3 faces have fewer than 3 corners, left out"}));
}

TEST(Ply, SkipsWhatItDoesNotKnow) {
  Bytes body(std::endian::little);
  body.add<uint16_t>(2).add(1.0).add(2.0).add<uint8_t>(5);  // extra: a list and a byte
  body.add<uint16_t>(0).add<uint8_t>(6);
  for (int v = 0; v < 3; ++v)
    body.add(float(v == 1)).add(float(v == 2)).add(0.f).add<uint8_t>(1).add<int16_t>(77);
  body.add<uint8_t>(200).add<uint32_t>(3).add<uint16_t>(0).add<uint16_t>(1).add<uint16_t>(2);
  const PlyMesh mesh = parse_ply(
      header("binary_little_endian",
             "comment made by hand\nobj_info none\nelement extra 2\nproperty list ushort double "
             "d\nproperty uchar e\nelement vertex 3\n" +
                 kXyz +
                 "property list uchar short l\nelement face 1\nproperty uchar "
                 "flag\nproperty list uint ushort vertex_indices\nelement tail 99\n"
                 "property double never_read\n") +
          body.text,
      "m.ply");
  EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(mesh.triangles, (std::vector<uint32_t>{0, 1, 2}));
}

TEST(Ply, LineEndsOfTheHeader) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : header("binary_little_endian", kTriangleElements))
      c == '\n' ? text += end : text += c;
    Bytes body(std::endian::little);
    // 0x0a as the first byte of the data: not a part of the header's last line.
    body.add<uint32_t>(0x3f80000au);
    for (float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) body.add(x);
    body.add<uint8_t>(3).add<int32_t>(0).add<int32_t>(1).add<int32_t>(2);
    const PlyMesh mesh = parse_ply(text + body.text, "m.ply");
    EXPECT_EQ(mesh.positions[0], std::bit_cast<float>(0x3f80000au));
  }
}

TEST(Ply, NumbersThatAreNotFinitePassThrough) {
  const PlyMesh mesh = parse_ply(
      header("ascii", kTriangleElements) + "nan inf -inf\n1 1e-400 0\n0 1 0\n3 0 1 2\n", "m.ply");
  EXPECT_TRUE(std::isnan(mesh.positions[0]));
  EXPECT_EQ(mesh.positions[1], INFINITY);
  EXPECT_EQ(mesh.positions[2], -INFINITY);
  EXPECT_EQ(mesh.positions[4], 0);
}

TEST(Ply, Errors) {
  const std::string good = header("ascii", kTriangleElements);
  const auto faces = [](const std::string& list) {
    return header("ascii", "element vertex 3\n" + kXyz + "element face 1\n" + list);
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "m.ply: not a PLY file (its first line is not \"ply\")"},
      {"solid x", "m.ply: not a PLY file (its first line is not \"ply\")"},
      {"ply\nformat ascii 1.0\n",
       "m.ply: header line 3: end_header is missing, the file is cut off or is no PLY file"},
      {"ply\nend_header\n", "m.ply: header line 2: the format line is missing"},
      {"ply\nformat binary 1.0\n", "m.ply: header line 2: unknown format \"binary\""},
      {"ply\nfoo\n", "m.ply: header line 2: unknown keyword \"foo\""},
      {"ply\nproperty float x\n",
       "m.ply: header line 2: a property comes before the first element"},
      {"ply\nelement vertex -1\n",
       "m.ply: header line 2: element \"vertex\" needs a count, found \"-1\""},
      {"ply\nelement vertex 99999999999999999999\n",
       "m.ply: header line 2: element \"vertex\" needs a count, found \"99999999999999999999\""},
      {"ply\nelement vertex 1\nproperty quad x\n",
       "m.ply: header line 3: unknown property type \"quad\", use char, uchar, short, ushort, int, "
       "uint, float or double"},
      {"ply\nelement vertex 1\nproperty list float int x\n",
       "m.ply: header line 3: the length of a list must have an integer type"},
      {"ply\nelement vertex 1\nproperty float\n", "m.ply: header line 3: a property has no name"},
      {header("ascii", "element face 1\nproperty list uchar int vertex_indices\n") + "3 0 1 2\n",
       "m.ply: has no vertices"},
      {header("ascii", "element vertex 3\n" + kXyz) + "0 0 0 1 0 0 0 1 0\n", "m.ply: has no faces"},
      {faces("property list uchar int corners\n") + kTriangleBody,
       "m.ply: its faces have no list vertex_indices"},
      {header("ascii",
              "element vertex 3\nproperty float x\nproperty float y\nelement face "
              "1\nproperty list uchar int vertex_indices\n") +
           "0 0 1 0 0 1 3 0 1 2\n",
       "m.ply: its vertices have no x, y and z"},
      {good + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       "m.ply: face 0 (counted from 0): vertex index 3 is out of range, the file has 3 vertices"},
      {good + "0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n",
       "m.ply: face 0 (counted from 0): vertex index -1 is out of range, the file has 3 vertices"},
      {good + "0 0 0\n1 0 0\n0 1 0\n3 0 .5 2\n",
       "m.ply: face 0 (counted from 0): vertex index 0.5 is out of range, the file has 3 vertices"},
      {good + "0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n",
       "m.ply: vertex 2 (counted from 0): \"x\" is not a number"},
      {good + "0 0 0\n1 0 0\n0 1e999 0\n3 0 1 2\n",
       "m.ply: vertex 2 (counted from 0): \"1e999\" is too large"},
      {good + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",
       "m.ply: face 0 (counted from 0): a list of -3 values"},
      {good + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
       "m.ply: the file ends in face 0 (counted from 0), it is cut off or its header counts too "
       "many"},
      {good + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "m.ply: has no triangles"},
      {header("binary_little_endian", "element vertex 4000000000\n" + kXyz +
                                          "element face 1\nproperty list uchar int "
                                          "vertex_indices\n") +
           "abc",
       "m.ply: the header counts 4000000000 rows of \"vertex\", but the file is too short for "
       "them, it is cut off or damaged"},
      {header("ascii", "element vertex 5000000000\n" + kXyz +
                           "element face 1\nproperty list uchar int vertex_indices\n"),
       "m.ply: 5000000000 vertices, more than 32-bit indices reach"},
      {header("ascii", "element vertex 1\nelement vertex 1\n"), "m.ply: two elements \"vertex\""},
  };
  for (const auto& [data, message] : cases) EXPECT_EQ(error_of(data), message) << data;
}

TEST(Ply, EveryTruncationIsAnError) {
  Bytes body(std::endian::little);
  for (float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) body.add(x);
  body.add<uint8_t>(3).add<int32_t>(0).add<int32_t>(1).add<int32_t>(2);
  const std::string whole = header("binary_little_endian", kTriangleElements) + body.text;
  EXPECT_EQ(error_of(whole), "no error");
  for (size_t n = 0; n < whole.size(); ++n)
    EXPECT_NE(error_of(whole.substr(0, n)), "no error") << n;
}

TEST(Ply, ListsLongerThanTheFileTakeNoMemory) {
  Bytes body(std::endian::little);
  for (float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) body.add(x);
  body.add<uint32_t>(0xffffffffu).add<int32_t>(0);
  EXPECT_EQ(error_of(header("binary_little_endian",
                            "element vertex 3\n" + kXyz +
                                "element face 1\nproperty list uint int vertex_indices\n") +
                     body.text),
            "m.ply: the file ends in face 0 (counted from 0), it is cut off or its header counts "
            "too many");
}

TEST(Ply, ElementsWithoutPropertiesTakeNoTime) {
  const PlyMesh mesh = parse_ply(
      header("ascii", "element nothing 18446744073709551615\n" + kTriangleElements) + kTriangleBody,
      "m.ply");
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

TEST(Ply, MissingFile) {
  try {
    read_ply("/nonexistent/m.ply");
    FAIL() << "no error";
  } catch (const PlyError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/m.ply: cannot be read: No such file or directory");
  }
  EXPECT_THROW(read_ply(std::filesystem::temp_directory_path().string()), PlyError);
}

TEST(Ply, ReadsAFile) {
  std::filesystem::create_directories(YAT_TEST_OUTPUT_DIR);
  const std::string path = YAT_TEST_OUTPUT_DIR "/read.ply";
  std::ofstream(path) << header("ascii", kTriangleElements) << kTriangleBody;
  EXPECT_EQ(read_ply(path).triangles.size(), 3u);
}

}  // namespace
}  // namespace yat
