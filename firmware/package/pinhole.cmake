# pinhole.cmake: the renderer as a library of your own project, for any CPU that CMake builds for, in a pico-sdk project, too:
#
#     include(path/to/pinhole.cmake)
#     target_link_libraries(yours PRIVATE Pinhole::pinhole)      # then: #include <pinhole/render.h>
#
# The sources are in ../core, in git as well as where they were installed. PINHOLE_CPU names a folder of core/kernels whose
# files replace the portable ones of the same name. Without it PICO_PLATFORM or the compiler's own macros decide.
if(TARGET Pinhole::pinhole)
    return()
endif()
get_filename_component(_core "${CMAKE_CURRENT_LIST_DIR}/../core" ABSOLUTE)

if(NOT PINHOLE_CPU AND PICO_PLATFORM)
    if(PICO_PLATFORM STREQUAL "rp2040")
        set(PINHOLE_CPU armv6m)
    elseif(PICO_PLATFORM MATCHES "^rp2350(-arm-s)?$")
        set(PINHOLE_CPU armv7m)
    elseif(PICO_PLATFORM STREQUAL "rp2350-riscv")
        set(PINHOLE_CPU rv32)
    else()
        set(PINHOLE_CPU portable)
    endif()
elseif(NOT PINHOLE_CPU)
    # The C compiler says which CPU it builds for, with the project's own flags.
    separate_arguments(_flags UNIX_COMMAND "${CMAKE_C_FLAGS}")
    execute_process(COMMAND "${CMAKE_C_COMPILER}" ${_flags} -dM -E -x c /dev/null OUTPUT_VARIABLE _macros ERROR_QUIET)
    if(_macros MATCHES "__ARM_ARCH_6M__|__ARM_ARCH_8M_BASE__")
        set(PINHOLE_CPU armv6m)
    elseif(_macros MATCHES "__ARM_ARCH_(7M|7EM|8M_MAIN|8_1M_MAIN)__")
        set(PINHOLE_CPU armv7m)
    elseif(_macros MATCHES "__riscv_xlen 32" AND _macros MATCHES "__riscv_mul " AND _macros MATCHES "__riscv_compressed ")
        set(PINHOLE_CPU rv32)
    elseif(_macros MATCHES "__x86_64__")
        set(PINHOLE_CPU x86_64)
    else()
        set(PINHOLE_CPU portable)
    endif()
endif()
if(NOT IS_DIRECTORY "${_core}/kernels/${PINHOLE_CPU}")
    message(FATAL_ERROR "pinhole.cmake: PINHOLE_CPU=${PINHOLE_CPU}: no such folder in ${_core}/kernels")
endif()

file(GLOB _sources "${_core}/fx/*.c" "${_core}/geom/*.c" "${_core}/render/*.c" "${_core}/effects/*.c")
set(_kernels "${_core}/kernels/portable" "${_core}/kernels/${PINHOLE_CPU}")
list(REMOVE_DUPLICATES _kernels)
foreach(_folder IN LISTS _kernels)
    file(GLOB _files "${_folder}/*.c" "${_folder}/*.S")
    foreach(_file IN LISTS _files)
        get_filename_component(_name "${_file}" NAME_WE)
        set(_kernel_${_name} "${_file}")
        list(APPEND _names ${_name})
    endforeach()
endforeach()
list(REMOVE_DUPLICATES _names)
foreach(_name IN LISTS _names)
    list(APPEND _sources "${_kernel_${_name}}")
endforeach()

# The public headers as <pinhole/...>, away from the private ones.
set(_include "${CMAKE_CURRENT_BINARY_DIR}/pinhole-include")
file(GLOB _headers "${_core}/*.h" "${_core}/fx/*.hpp" "${_core}/kernels/portable/fx_cpu.h")
file(COPY ${_headers} DESTINATION "${_include}/pinhole")

# Assembly goes through the C compiler, so that it gets the project's C flags (-mcpu=...).
file(GLOB _assembly "${_core}/kernels/*/*.S")
set_source_files_properties(${_assembly} PROPERTIES LANGUAGE C)
add_library(pinhole_core STATIC EXCLUDE_FROM_ALL ${_sources})
add_library(Pinhole::pinhole ALIAS pinhole_core)
set_target_properties(pinhole_core PROPERTIES C_STANDARD 11 OUTPUT_NAME pinhole)
target_compile_options(pinhole_core PRIVATE -O3)
target_include_directories(pinhole_core PUBLIC "${_include}")
target_include_directories(pinhole_core PRIVATE "${_core}/kernels/${PINHOLE_CPU}" "${_core}/kernels/portable" "${_core}"
    "${_core}/render" "${_core}/kernels" "${_core}/fx")
