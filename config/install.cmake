# Installs the libraries that exist, one export set and component each, and the package that finds them:
# find_package(halfsilver COMPONENTS renderer builtin io context exact).
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/halfsilver)
set(header_folder ${CMAKE_INSTALL_INCLUDEDIR}/halfsilver)

set(HALFSILVER_COMPONENTS)
foreach(name IN ITEMS renderer builtin io context exact)
  if(TARGET halfsilver_${name})
    list(APPEND HALFSILVER_COMPONENTS ${name})
    install(TARGETS halfsilver_${name} EXPORT halfsilver-${name} ARCHIVE COMPONENT ${name})
    install(EXPORT halfsilver-${name} NAMESPACE halfsilver:: DESTINATION ${package_folder} COMPONENT ${name})
  endif()
endforeach()

# The public headers and nothing else: those of a component with it, all others with the renderer. The structs shared
# with shaders are public too, since a caller's own tracer reads rays and writes hits.
install(DIRECTORY renderer/include/halfsilver/ DESTINATION ${header_folder} COMPONENT renderer
        FILES_MATCHING PATTERN "*.h"
        PATTERN builtin.h EXCLUDE PATTERN io.h EXCLUDE PATTERN context.h EXCLUDE PATTERN exact.h EXCLUDE)
install(FILES shaders/shared/bindings.h shaders/shared/rays.h shaders/shared/structs.h DESTINATION ${header_folder}/shared
        COMPONENT renderer)
foreach(name IN ITEMS builtin io context exact)
  if(TARGET halfsilver_${name})
    install(FILES renderer/include/halfsilver/${name}.h DESTINATION ${header_folder} COMPONENT ${name})
  endif()
endforeach()

configure_package_config_file(config/halfsilver-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config.cmake config/find_webp.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config-version.cmake
        DESTINATION ${package_folder} COMPONENT renderer)
