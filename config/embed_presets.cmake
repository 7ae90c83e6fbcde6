# Embeds every config/*.toml in a library: writes a source that implements presetFiles(). Included, it offers the
# function below; run as a script (cmake -DROOT=... -DOUTPUT=... -P), it writes that source.

if(CMAKE_SCRIPT_MODE_FILE)
  file(GLOB files ${ROOT}/*.toml)
  list(SORT files)
  set(entries "")
  foreach(file IN LISTS files)
    file(READ ${file} text)
    get_filename_component(name ${file} NAME_WE)
    string(APPEND entries "    {\"${name}\", R\"__toml__(${text})__toml__\"},\n")
  endforeach()
  file(WRITE ${OUTPUT}
"#include <halfsilver/io.h>

namespace halfsilver {
namespace {

const PresetFile kFiles[] = {
${entries}};

}  // namespace

std::span<const PresetFile> presetFiles() { return kFiles; }

}  // namespace halfsilver
")
  return()
endif()

set(HALFSILVER_PRESETS_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(halfsilver_embed_presets target)
  set(root ${PROJECT_SOURCE_DIR}/config)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/preset_files.cpp)
  file(GLOB files CONFIGURE_DEPENDS ${root}/*.toml)
  # The list of names is a dependency of its own: a removed file leaves no newer one behind.
  set(list ${CMAKE_CURRENT_BINARY_DIR}/preset_files.txt)
  file(CONFIGURE OUTPUT ${list} CONTENT "${files}" @ONLY)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DROOT=${root} -DOUTPUT=${output} -P ${HALFSILVER_PRESETS_SCRIPT}
    DEPENDS ${files} ${list} ${HALFSILVER_PRESETS_SCRIPT}
    COMMENT "Embedding presets"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
