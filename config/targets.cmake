# How the project's own targets are made.

# Language level and warnings of our own code; nothing of it reaches code that links to us.
function(halfsilver_own_code target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU,Clang>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror>
    $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)  # GCC's -Wconversion has it not
  target_link_options(${target} PRIVATE $<$<PLATFORM_ID:Linux>:LINKER:--as-needed>)
  # Where programs find the module halfsilver_openimageio.
  set_target_properties(${target} PROPERTIES BUILD_RPATH ${PROJECT_BINARY_DIR}
                                             INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endfunction()

# A static library halfsilver_<name>, alias halfsilver::<name>, of all sources in the named rooms of renderer/ and
# their folders, without the files and folders in EXCLUDE (paths below renderer/). A room without sources makes no target.
function(halfsilver_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ROOMS;EXCLUDE")
  set(sources)
  foreach(room IN LISTS arg_ROOMS)
    if(room STREQUAL ".")
      file(GLOB found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/renderer/*.cpp)
    else()
      file(GLOB_RECURSE found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/renderer/${room}/*.cpp)
    endif()
    list(APPEND sources ${found})
  endforeach()
  foreach(path IN LISTS arg_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "/renderer/${path}(/|$)")
  endforeach()
  if(NOT sources)
    return()
  endif()
  set(target halfsilver_${name})
  add_library(${target} STATIC ${sources})
  add_library(halfsilver::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  halfsilver_own_code(${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/renderer/include>
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/renderer>
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/shaders>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()
