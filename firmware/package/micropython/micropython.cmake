# Pinhole as a module of MicroPython's ports that are built by CMake (rp2, esp32):
#
#     make -C ports/rp2 BOARD=RPI_PICO USER_C_MODULES=path/to/pinhole/firmware/package/micropython/micropython.cmake
#
# Ports that are built by make take firmware/micropython.mk. The CPU's own files of core/kernels are chosen as ../pinhole.cmake says.
include(${CMAKE_CURRENT_LIST_DIR}/../pinhole.cmake)

add_library(usermod_pinhole INTERFACE)
file(GLOB _module ${CMAKE_CURRENT_LIST_DIR}/*.c)
set(_firmware ${CMAKE_CURRENT_LIST_DIR}/../..)
target_sources(usermod_pinhole INTERFACE ${_module})
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/app.txt _names) # of firmware/app, for Model
foreach(_name IN LISTS _names)
    target_sources(usermod_pinhole INTERFACE ${_firmware}/app/${_name}.c)
endforeach()
target_include_directories(usermod_pinhole INTERFACE ${_firmware}/core ${_firmware}/core/kernels/portable ${_firmware}/app ${_firmware}/app/demos ${_firmware}/../hal)
target_link_libraries(usermod_pinhole INTERFACE Pinhole::pinhole)
target_link_libraries(usermod INTERFACE usermod_pinhole)
