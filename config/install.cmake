# Installs the libraries that exist, one export set and component each, and the package that finds them:
# find_package(halfsilver COMPONENTS renderer io context exact).
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/halfsilver)
set(header_folder ${CMAKE_INSTALL_INCLUDEDIR}/halfsilver)

set(HALFSILVER_COMPONENTS)
foreach(name IN ITEMS renderer io context exact)
  if(TARGET halfsilver_${name})
    list(APPEND HALFSILVER_COMPONENTS ${name})
    install(TARGETS halfsilver_${name} EXPORT halfsilver-${name} ARCHIVE COMPONENT ${name})
    install(EXPORT halfsilver-${name} NAMESPACE halfsilver:: DESTINATION ${package_folder} COMPONENT ${name})
  endif()
endforeach()

# Headers keep their rooms: <halfsilver/renderer.h> includes "scene/scene.h".
install(FILES renderer/settings.h renderer/renderer.h renderer/budget.h DESTINATION ${header_folder} COMPONENT renderer)
install(DIRECTORY renderer/core renderer/scene renderer/gl renderer/frame DESTINATION ${header_folder}
        COMPONENT renderer FILES_MATCHING PATTERN "*.h")
install(FILES renderer/tracing/tracer.h DESTINATION ${header_folder}/tracing COMPONENT renderer)
install(DIRECTORY shaders/shared DESTINATION ${header_folder} COMPONENT renderer FILES_MATCHING PATTERN "*.h")
foreach(name IN ITEMS io context exact)
  if(TARGET halfsilver_${name})
    install(DIRECTORY renderer/${name} DESTINATION ${header_folder} COMPONENT ${name} FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()

configure_package_config_file(config/halfsilver-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/halfsilver-config-version.cmake
        DESTINATION ${package_folder} COMPONENT renderer)
