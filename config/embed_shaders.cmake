# Embeds every file below shaders/ in a library: writes a source that implements gl::shaderFiles(). Included, it offers
# the function below; run as a script (cmake -DROOT=... -DOUTPUT=... -P), it writes that source.

if(CMAKE_SCRIPT_MODE_FILE)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/*)
  list(FILTER files EXCLUDE REGEX "\\.md$")
  list(SORT files)
  set(entries "")
  foreach(file IN LISTS files)
    file(READ ${ROOT}/${file} text)
    string(APPEND entries "    {\"${file}\", R\"__glsl__(${text})__glsl__\"},\n")
  endforeach()
  file(WRITE ${OUTPUT}
"#include \"gl/shader_files.h\"

namespace halfsilver::gl {
namespace {

const ShaderFile kFiles[] = {
${entries}};

}  // namespace

std::span<const ShaderFile> shaderFiles() { return kFiles; }

}  // namespace halfsilver::gl
")
  return()
endif()

set(HALFSILVER_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(halfsilver_embed_shaders target)
  set(root ${PROJECT_SOURCE_DIR}/shaders)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/shader_files.cpp)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${root}/*)
  # The list of names is a dependency of its own: a removed file leaves no newer one behind.
  set(list ${CMAKE_CURRENT_BINARY_DIR}/shader_files.txt)
  file(CONFIGURE OUTPUT ${list} CONTENT "${files}" @ONLY)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DROOT=${root} -DOUTPUT=${output} -P ${HALFSILVER_EMBED_SCRIPT}
    DEPENDS ${files} ${list} ${HALFSILVER_EMBED_SCRIPT}
    COMMENT "Embedding shaders"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
