# halfsilver_demo: the module of `halfsilver demo`, the only user of GLFW and Dear ImGui.
find_package(glfw3 3.3 REQUIRED)
find_path(HALFSILVER_IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui REQUIRED DOC "Dear ImGui (Debian: libimgui-dev)")
find_library(HALFSILVER_IMGUI imgui REQUIRED)
find_library(HALFSILVER_STB stb REQUIRED DOC "What Debian's Dear ImGui takes fonts with (libstb-dev)")
find_file(HALFSILVER_DEMO_FONT DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu /usr/share/fonts/dejavu-sans-fonts
  DOC "Font of the overlay (Debian: fonts-dejavu-core); without it Dear ImGui's own")
mark_as_advanced(HALFSILVER_IMGUI_INCLUDE HALFSILVER_IMGUI HALFSILVER_STB HALFSILVER_DEMO_FONT)

file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/renderer/apps/demo/*.cpp)
add_library(halfsilver_demo MODULE ${sources})
halfsilver_own_code(halfsilver_demo)
target_include_directories(halfsilver_demo SYSTEM PRIVATE ${HALFSILVER_IMGUI_INCLUDE})
target_link_libraries(halfsilver_demo PRIVATE halfsilver_game halfsilver_apps glfw ${HALFSILVER_IMGUI} ${HALFSILVER_STB}
  ${CMAKE_DL_LIBS})
target_compile_definitions(halfsilver_demo PRIVATE GLFW_INCLUDE_NONE
  HALFSILVER_DEMO_FONT="$<$<BOOL:${HALFSILVER_DEMO_FONT}>:${HALFSILVER_DEMO_FONT}>")
add_dependencies(halfsilver halfsilver_demo)
install(TARGETS halfsilver_demo LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT programs)
