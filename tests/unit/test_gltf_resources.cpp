#include <gtest/gtest.h>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "gltf_loading.h"
#include "io/gltf_uri.h"

// Where buffers and images come from: chunks of a .glb, files, data URIs.
namespace halfsilver::testing {
namespace {

using gltf::readUri;

// The message, or nothing if the file loads.
std::string load(const std::filesystem::path& file) {
  try {
    loadGltf(file);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    return error.what();
  }
}

TEST(GltfResources, AUriNamesTheFileThatItsEscapesSpell) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "scene" / "sub");
  folder.write("outside.bin", "outside");
  for (const char* name : {"a+b", "a b", "100%", "c#1", "d?e", "\xc3\xa9", "sub/inner"})
    folder.write("scene/" + std::string(name), name);
  const auto read = [&](const char* uri) { return textOf(readUri(uri, folder.path() / "scene")); };
  EXPECT_EQ(read("a+b"), "a+b") << "a plus is a plus";
  EXPECT_EQ(read("a%2Bb"), "a+b");
  EXPECT_EQ(read("a%2bb"), "a+b");
  EXPECT_EQ(read("a%20b"), "a b");
  EXPECT_EQ(read("a b"), "a b") << "not escaped, as some programs leave it";
  EXPECT_EQ(read("100%25"), "100%");
  EXPECT_EQ(read("100%"), "100%") << "not an escape";
  EXPECT_EQ(read("c%231"), "c#1");
  EXPECT_EQ(read("c#1"), "c#1") << "there is no file c";
  EXPECT_EQ(read("a+b#part"), "a+b") << "a fragment is no part of the name";
  EXPECT_EQ(read("a+b?version=2"), "a+b") << "nor is a query";
  EXPECT_EQ(read("%C3%A9"), "\xc3\xa9");
  EXPECT_EQ(read("./sub/../a+b"), "a+b");
  EXPECT_EQ(read("sub%2Finner"), "sub/inner");
  EXPECT_EQ(read("sub//inner"), "sub/inner");
}

TEST(GltfResources, NothingOutsideTheFolderIsRead) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "scene" / "sub");
  folder.write("outside", "outside");
  folder.write("scene/a", "a");
  const std::string absolute = (folder.path() / "scene" / "a").string();
  for (const std::string& uri :
       {std::string("../outside"), std::string("sub/../../outside"), std::string("%2e%2e/outside"),
        std::string("..%2foutside"), absolute, "file://" + absolute, std::string("http://host/a"),
        std::string("//host/a"), std::string("a%00"), std::string("a\0", 2), std::string("%00"), std::string(""),
        std::string("sub"), std::string("absent")}) {
    const gltf::Resource resource = readUri(uri, folder.path() / "scene");
    EXPECT_TRUE(resource.bytes.empty()) << uri;
    EXPECT_FALSE(resource.problem.empty()) << uri;
  }
  EXPECT_NE(readUri("../outside", folder.path() / "scene").problem.find("out of the scene's folder"),
            std::string::npos);
  EXPECT_NE(readUri("a%00", folder.path() / "scene").problem.find("zero"), std::string::npos);
  EXPECT_NE(readUri("http://host/a", folder.path() / "scene").problem.find("http:"), std::string::npos);
}

TEST(GltfResources, DataMayHaveAnyMediaTypeParametersAndCase) {
  for (const char* head : {"data:application/octet-stream;base64,", "data:application/gltf-buffer;base64,",
                           "data:image/png;base64,", "data:;base64,", "DATA:Text/Plain;CharSet=UTF-8;BASE64,",
                           "data:application/x;a=b;c=\"d;e\";base64,", "data:image/ktx2;base64,"})
    EXPECT_EQ(textOf(readUri(std::string(head) + "aGk+Lw==", {})), "hi>/") << head;
  EXPECT_EQ(textOf(readUri("data:;base64,aGk%2BLw%3D%3D", {})), "hi>/") << "escaped base64";
  EXPECT_EQ(textOf(readUri("data:;base64,aGk+\n Lw", {})), "hi>/") << "without padding";
  EXPECT_EQ(textOf(readUri("data:,a%20b+c", {})), "a b+c") << "without base64";
  EXPECT_EQ(textOf(readUri("data:text/plain;charset=US-ASCII,%00%FF", {})), std::string("\0\xff", 2));
  for (const char* uri :
       {"data:;base64,a", "data:;base64,a=b=", "data:;base64,****", "data:", "data:;base64", "data:,%zz"})
    EXPECT_FALSE(readUri(uri, {}).problem.empty()) << uri;
}

TEST(GltfResources, ABufferIsReadFromEveryKindOfUri) {
  GltfFile file;
  file.triangle();
  const TemporaryFolder folder;
  folder.write("geo+metry.bin", file.buffer);
  std::string escaped;
  for (const char c : file.buffer) {
    char digits[4];
    std::snprintf(digits, sizeof(digits), "%%%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    escaped += digits;
  }
  for (const std::string& uri :
       {std::string("geo+metry.bin"), "data:application/gltf-buffer;base64," + base64(file.buffer),
        "data:application/octet-stream," + escaped})
    EXPECT_EQ(load(folder.write("scene.gltf", file.gltf(uri))), "") << uri;
  EXPECT_NE(load(folder.write("scene.gltf", file.gltf("geo%20metry.bin"))).find("buffers[0] \"geo%20metry.bin\""),
            std::string::npos)
      << "the line names the file";
  folder.write("short.bin", "short");
  EXPECT_NE(load(folder.write("scene.gltf", file.gltf("short.bin"))).find("has 5 bytes, but declares 36"),
            std::string::npos);
}

std::string word(std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  return {reinterpret_cast<const char*>(&number), 4};
}

std::string glbOf(const std::vector<std::pair<std::string, std::string>>& chunks) {
  std::string body;
  for (const auto& [type, data] : chunks) body += word(data.size()) + type + data;
  return "glTF" + word(2) + word(12 + body.size()) + body;
}

TEST(GltfResources, UnknownChunksAreSkippedAndTheBinaryOneMayBeEmptyOrAbsent) {
  const TemporaryFolder folder;
  const std::string binary("BIN\0", 4);
  GltfFile file;
  file.triangle();
  const std::string outside = file.gltf();
  for (const auto& chunks : std::vector<std::vector<std::pair<std::string, std::string>>>{
           {{"JSON", outside}},
           {{"JSON", outside}, {binary, ""}},
           {{"JSON", outside}, {"XXXX", "unknown!"}},
           {{"JSON", outside}, {"XXXX", "odd"}, {binary, "unused"}},
           {{"JSON", outside + std::string(3, '\0')}}})
    EXPECT_EQ(load(folder.write("scene.glb", glbOf(chunks))), "");
  json inside = file.root;
  inside["buffers"] = json::array({{{"byteLength", file.buffer.size()}}});
  EXPECT_EQ(load(folder.write("scene.glb", glbOf({{"JSON", inside.dump()}, {"XXXX", "x"}, {binary, file.buffer}}))), "")
      << "a chunk before the binary one";
  EXPECT_EQ(load(folder.write("scene.glb", glbOf({{"JSON", inside.dump()}, {binary, file.buffer}, {"YYYY", ""}}))), "");
  EXPECT_NE(load(folder.write("scene.glb", glbOf({{"JSON", inside.dump()}, {binary, ""}}))).find("0 bytes"),
            std::string::npos);
  EXPECT_NE(load(folder.write("scene.glb", glbOf({{"JSON", inside.dump()}, {"XXXX", ""}}))).find("no data"),
            std::string::npos);
  EXPECT_NE(load(folder.write("scene.glb", glbOf({{binary, file.buffer}, {"JSON", inside.dump()}}))).find("JSON chunk"),
            std::string::npos);
  std::string cut = glbOf({{"JSON", inside.dump()}, {binary, file.buffer}, {"XXXX", "123456789"}});
  cut[cut.size() - 17] = 100;  // the last chunk's length
  EXPECT_NE(load(folder.write("scene.glb", cut)).find("chunk 2"), std::string::npos);
}

TEST(GltfResources, PointsAndLinesAreCountedInOneWarning) {
  GltfFile file;
  file.triangle();
  const int six = file.accessor(std::vector<float>(18, 1), "VEC3");
  for (const int mode : {0, 1, 2, 3}) file.primitive({{"POSITION", six}})["mode"] = mode;
  const TemporaryFolder folder;
  const Model model = loadGltf(folder.write("scene.glb", file.glb()));
  EXPECT_EQ(model.scene.triangles.size(), 1u);
  std::size_t found = 0;
  for (const std::string& warning : model.warnings)
    found += warning.find("6 points and 14 lines in 4 primitives") != std::string::npos;
  EXPECT_EQ(found, 1u);
}

}  // namespace
}  // namespace halfsilver::testing
