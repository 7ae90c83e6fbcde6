# Debian's libwebp-dev brings no CMake package: the target WebP::webp.
find_path(HALFSILVER_WEBP_INCLUDE webp/decode.h REQUIRED DOC "WebP headers (Debian: libwebp-dev)")
find_library(HALFSILVER_WEBP_LIBRARY webp REQUIRED)
mark_as_advanced(HALFSILVER_WEBP_INCLUDE HALFSILVER_WEBP_LIBRARY)
if(NOT TARGET WebP::webp)
  add_library(WebP::webp UNKNOWN IMPORTED)
  set_target_properties(WebP::webp PROPERTIES IMPORTED_LOCATION ${HALFSILVER_WEBP_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${HALFSILVER_WEBP_INCLUDE})
endif()
