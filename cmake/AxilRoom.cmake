# axil_room(NAME HEADERS ... [SOURCES ...] [DEPENDS rooms ...] [DATA files ...] [PACKAGES targets ...])
#
# One room, one target `axil::NAME`. Headers are verified to compile alone. DEPENDS are the rooms whose headers it may
# include (PUBLIC); PACKAGES stay PRIVATE. DATA files are compiled in: `axil::NAME::data::FILE_STEM` is a string_view,
# declared in "NAME/data.hpp" (generated).
set(CMAKE_VERIFY_INTERFACE_HEADER_SETS ON)

# Numbers must not depend on the compiler's taste: no fused multiply-add, no fast math.
add_compile_options(-ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wno-restrict)  # g++ 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105329)
endif()
if(AXIL_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

function(axil_room name)
  cmake_parse_arguments(ROOM "" "" "HEADERS;SOURCES;DEPENDS;DATA;PACKAGES" ${ARGN})
  add_library(axil_${name} STATIC)
  add_library(axil::${name} ALIAS axil_${name})
  list(TRANSFORM ROOM_HEADERS PREPEND ${CMAKE_SOURCE_DIR}/${name}/)
  target_sources(axil_${name} PRIVATE ${ROOM_SOURCES}
                 PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR} FILES ${ROOM_HEADERS})
  list(TRANSFORM ROOM_DEPENDS PREPEND axil::)
  target_link_libraries(axil_${name} PUBLIC ${ROOM_DEPENDS} PRIVATE ${ROOM_PACKAGES})
  if(ROOM_DATA)
    axil_embed(axil_${name} ${name} ${ROOM_DATA})
  endif()
endfunction()

# Compiles text files into the target, so that the program needs no data folder at run time.
function(axil_embed target room)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  set(paths "")
  foreach(file ${ARGN})
    list(APPEND paths ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  string(REPLACE ";" "|" joined "${paths}")
  add_custom_command(
    OUTPUT ${folder}/${room}/data.hpp ${folder}/${room}/data.cpp
    COMMAND ${CMAKE_COMMAND} -DROOM=${room} "-DFILES=${joined}" -DFOLDER=${folder}/${room} -P ${CMAKE_SOURCE_DIR}/cmake/EmbedText.cmake
    DEPENDS ${paths} ${CMAKE_SOURCE_DIR}/cmake/EmbedText.cmake VERBATIM)
  target_sources(${target} PRIVATE ${folder}/${room}/data.cpp ${folder}/${room}/data.hpp)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
