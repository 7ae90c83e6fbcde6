#include "gl/program_cache.h"

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <system_error>
#include <vector>

#include <halfsilver/cache_folder.h>

namespace halfsilver::gl {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxFileBytes = std::uint64_t{64} << 20;     // larger ones are not ours
constexpr std::uint64_t kMaxFolderBytes = std::uint64_t{256} << 20;  // the oldest files go

// A file: this, then the driver's bytes.
struct Header {
  char magic[8] = {'H', 'S', 'P', 'R', 'O', 'G', '1', '\n'};
  std::uint64_t key = 0, keyBytes = 0;
  std::uint64_t format = 0;  // the driver's
  std::uint64_t bytes = 0, checksum = 0;
};

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
  return hash ^ (hash >> 29);
}

std::uint64_t hashOf(std::span<const std::byte> bytes, std::uint64_t hash) {
  std::uint64_t word = 0;
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(word)) {
    word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof(word), bytes.size() - at));
    hash = mixed(hash, word);
  }
  return mixed(hash, bytes.size());
}

std::optional<std::vector<std::byte>> readFile(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > kMaxFileBytes) return std::nullopt;
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  std::ifstream in(path, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) return std::nullopt;
  return bytes;
}

bool writeAll(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

// Others see the whole file or none.
void writeFile(const fs::path& path, std::span<const std::byte> header, std::span<const std::byte> bytes) {
  std::string temporary = (path.parent_path() / ".XXXXXX").string();
  const int file = ::mkstemp(temporary.data());
  if (file < 0) return;
  bool whole = writeAll(file, header) && writeAll(file, bytes);
  whole = ::close(file) == 0 && whole;
  std::error_code error;
  if (whole) fs::rename(temporary, path, error);
  if (!whole || error) ::unlink(temporary.c_str());
}

constexpr const char* kExtension = ".program";

// Removes programs that were not used longest until the rest has few enough bytes.
void prune(const fs::path& folder) {
  struct File {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes;
  };
  std::vector<File> files;
  std::uint64_t sum = 0;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;  // another process may remove files, too
    if (it->path().extension() != kExtension || !it->is_regular_file(gone)) continue;  // the folder may hold more
    File file{it->path(), it->last_write_time(gone), it->file_size(gone)};
    if (gone) continue;
    sum += file.bytes;
    files.push_back(std::move(file));
  }
  if (sum <= kMaxFolderBytes) return;
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.used < b.used; });
  for (const File& file : files) {
    if (sum <= kMaxFolderBytes) return;
    fs::remove(file.path, error);
    sum -= file.bytes;
  }
}

bool knows(const Api& api, std::uint64_t format) {
  return std::find(api.programFormats.begin(), api.programFormats.end(), format) != api.programFormats.end();
}

}  // namespace

ProgramKey::ProgramKey(const Api& api) : name_(0x243F6A8885A308D3u), check_(0x13198A2E03707344u) {
  for (const std::string* text : {&api.vendor, &api.renderer, &api.version}) add(*text);
}

void ProgramKey::add(std::string_view text) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text.data(), text.size()));
  name_ = hashOf(bytes, name_);
  check_ = hashOf(bytes, check_);
  bytes_ += text.size();
}

void ProgramKey::add(GLenum stage, std::string_view source) {
  name_ = mixed(name_, stage);
  check_ = mixed(check_, stage);
  add(source);
}

std::string ProgramKey::file() const {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(name_ >> shift) & 15];
  return text + kExtension;
}

bool keepsPrograms(const Api& api) { return !api.programFormats.empty() && !cacheFolder().empty(); }

GLuint loadProgram(const Api& api, const ProgramKey& key) {
  if (!keepsPrograms(api)) return 0;
  const fs::path path = cacheFolder() / key.file();
  const std::optional<std::vector<std::byte>> file = readFile(path);
  Header header;
  if (!file || file->size() < sizeof(header)) return 0;
  std::memcpy(&header, file->data(), sizeof(header));
  const std::span<const std::byte> bytes = std::span(*file).subspan(sizeof(header));
  if (std::memcmp(header.magic, Header().magic, sizeof(header.magic)) != 0 || header.key != key.check() ||
      header.keyBytes != key.bytes() || header.bytes != bytes.size() || header.checksum != hashOf(bytes, header.key) ||
      !knows(api, header.format))
    return 0;
  const GLuint program = api.CreateProgram();
  api.ProgramBinary(program, static_cast<GLenum>(header.format), bytes.data(), static_cast<GLsizei>(bytes.size()));
  GLint linked = 0;
  api.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked) {
    for (int i = 0; i < 8 && api.GetError() != GL_NO_ERROR; ++i) continue;  // a refusal is no error of ours
    api.DeleteProgram(program);
    return 0;
  }
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // it is in use, see prune()
  return program;
}

void storeProgram(const Api& api, GLuint program, const ProgramKey& key) {
  if (!keepsPrograms(api)) return;
  GLint length = 0;
  api.GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
  if (length <= 0 || static_cast<std::uint64_t>(length) > kMaxFileBytes - sizeof(Header)) return;
  std::vector<std::byte> bytes(static_cast<std::size_t>(length));
  GLenum format = 0;
  GLsizei written = 0;
  api.GetProgramBinary(program, length, &written, &format, bytes.data());
  if (written <= 0) return;
  bytes.resize(static_cast<std::size_t>(written));
  const Header header{.key = key.check(),
                      .keyBytes = key.bytes(),
                      .format = format,
                      .bytes = bytes.size(),
                      .checksum = hashOf(bytes, key.check())};
  const fs::path folder = cacheFolder();
  std::error_code error;
  if (fs::create_directories(folder, error)) fs::permissions(folder, fs::perms::owner_all, error);
  writeFile(folder / key.file(), std::as_bytes(std::span(&header, 1)), bytes);
  prune(folder);
}

}  // namespace halfsilver::gl
