#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace halfsilver {

// A file that appears complete or not at all: it is written under a temporary name in its target's folder and renamed
// by commit(); without commit() the temporary file is removed. Move-only.
//
// Every function throws Error (failed) with one line that names the target.
class AtomicFile {
 public:
  // Checks at once that the folder accepts new files and that the target is not a folder or a device, so that no long
  // work is wasted. A target that is a symbolic link stays one; the file behind it is replaced.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Replaces the contents of the temporary file.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);
  // Renames the temporary file to the target. Call after write().
  void commit();

 private:
  void removeTemporary() noexcept;

  std::filesystem::path shown_;   // as the caller named it
  std::filesystem::path target_;  // links resolved
  std::filesystem::path temporary_;
  bool written_ = false;
};

}  // namespace halfsilver
