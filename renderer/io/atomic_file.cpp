#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw Error(ErrorKind::failed, file.string() + ": cannot be written: " + what);
}

std::string systemMessage(int code) { return std::system_category().message(code); }

// Creates a new file that no other process has open.
int openNew(const fs::path& path) { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); }

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : shown_(target), target_(target) {
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(target, error))) target_ = fs::weakly_canonical(target, error);
  const fs::file_status status = fs::status(target_, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    fail(shown_, fs::is_directory(status) ? "it is a folder" : "it is not a regular file");
  // Not derived from the target's name, which may already be as long as the file system allows.
  temporary_ = target_.parent_path() / (".halfsilver-" + std::to_string(::getpid()) + "-" +
                                        std::to_string(std::hash<std::string>{}(target_.filename().string())) + ".tmp");
  ::unlink(temporary_.c_str());
  const int file = openNew(temporary_);
  if (file < 0) fail(shown_, systemMessage(errno));
  ::close(file);
  ::unlink(temporary_.c_str());
}

AtomicFile::~AtomicFile() { removeTemporary(); }

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      written_(std::exchange(other.written_, false)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(shown_, other.shown_);
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(written_, other.written_);
  return *this;
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  removeTemporary();
  const int file = openNew(temporary_);
  if (file < 0) fail(shown_, systemMessage(errno));
  written_ = true;
  std::size_t done = 0;
  int code = 0;
  while (done < bytes.size() && code == 0) {
    const ssize_t count = ::write(file, bytes.data() + done, std::min(bytes.size() - done, std::size_t{1} << 30));
    if (count >= 0)
      done += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      code = errno;
  }
  // A full disk may show only here.
  if (::close(file) != 0 && code == 0) code = errno;
  if (code != 0) {
    removeTemporary();
    fail(shown_, systemMessage(code));
  }
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }

void AtomicFile::commit() {
  if (!written_) fail(shown_, "nothing was given to write");
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(shown_, error.message());
  written_ = false;
}

void AtomicFile::removeTemporary() noexcept {
  if (written_) ::unlink(temporary_.c_str());
  written_ = false;
}

}  // namespace halfsilver
