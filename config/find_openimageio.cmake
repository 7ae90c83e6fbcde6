# The target OpenImageIO::OpenImageIO, found by its files. Debian's own CMake package for it fails without
# openimageio-tools (the viewer, with Qt) and names an include folder (opencv4) that its packages do not bring.
find_path(HALFSILVER_OPENIMAGEIO_INCLUDE OpenImageIO/imageio.h REQUIRED
          DOC "OpenImageIO 2.4 (Debian: libopenimageio-dev)")
find_library(HALFSILVER_OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(HALFSILVER_OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
mark_as_advanced(HALFSILVER_OPENIMAGEIO_INCLUDE HALFSILVER_OPENIMAGEIO_LIBRARY HALFSILVER_OPENIMAGEIO_UTIL_LIBRARY)

if(NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO SHARED IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    IMPORTED_LOCATION ${HALFSILVER_OPENIMAGEIO_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${HALFSILVER_OPENIMAGEIO_INCLUDE}
    INTERFACE_LINK_LIBRARIES ${HALFSILVER_OPENIMAGEIO_UTIL_LIBRARY})
endif()
