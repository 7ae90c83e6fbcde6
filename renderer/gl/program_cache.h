#pragma once

#include <string>
#include <string_view>

#include <halfsilver/gl/api.h>

// Linked programs on disk, as the driver gives them out (glGetProgramBinary), so that a program is compiled once for a
// driver and not at each start. They lie in <halfsilver/cache_folder.h>.
//
// Nothing here fails: where there is no folder, where it cannot be written or read, where a file is damaged and where
// the driver refuses what another one has made, programs are compiled.
namespace halfsilver::gl {

// What makes a program another one, for a driver.
class ProgramKey {
 public:
  // Of the device that the table belongs to.
  explicit ProgramKey(const Api& api);
  void add(GLenum stage, std::string_view source);

  std::string file() const;  // its name
  std::uint64_t check() const { return check_; }
  std::uint64_t bytes() const { return bytes_; }  // of all that makes it

 private:
  void add(std::string_view text);

  std::uint64_t name_, check_, bytes_ = 0;  // two hashes of the same text
};

// Whether programs are kept: programs to be stored need GL_PROGRAM_BINARY_RETRIEVABLE_HINT when they are linked.
bool keepsPrograms(const Api& api);

// The linked program of the key, which the caller deletes; 0 if there is none.
GLuint loadProgram(const Api& api, const ProgramKey& key);
void storeProgram(const Api& api, GLuint program, const ProgramKey& key);

}  // namespace halfsilver::gl
