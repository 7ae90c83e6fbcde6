#pragma once

#include <dlfcn.h>

#include <initializer_list>
#include <string>

#include <halfsilver/error.h>

namespace halfsilver {

// A shared library opened at run time. It stays loaded until the process ends: drivers keep threads and thread-local
// destructors that must not be unloaded.
class Library {
 public:
  // The first of the names that opens. Throws Error (noContext) that lists the names.
  explicit Library(std::initializer_list<std::string> names) {
    std::string tried;
    for (const std::string& name : names) {
      // RTLD_LOCAL, so that one library's GL entry points never replace those of another.
      handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
      if (handle_) return;
      tried += (tried.empty() ? "" : " or ") + name;
    }
    throw Error(ErrorKind::noContext, "the library " + tried + " cannot be loaded");
  }

  // Throws Error (noContext) that names a missing function.
  template <class Function>
  void load(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(dlsym(handle_, name));
    if (!function) throw Error(ErrorKind::noContext, std::string("the library has no function ") + name);
  }

 private:
  void* handle_ = nullptr;
};

}  // namespace halfsilver
