# Writes a C++ file with the page in it: cmake -DFOLDER=… -DOUT=… -P embed.cmake
#
# Each file of FOLDER becomes an array of its bytes, and pageFiles() lists them; index.html is the path "/".
set(types html "text/html\; charset=utf-8" css "text/css\; charset=utf-8" js "text/javascript\; charset=utf-8"
          svg "image/svg+xml" webmanifest "application/manifest+json")

file(GLOB files ${FOLDER}/*.html ${FOLDER}/*.css ${FOLDER}/*.js ${FOLDER}/*.svg)
set(arrays "")
set(list "")
set(count 0)
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME)
  get_filename_component(ending ${file} LAST_EXT)
  string(SUBSTRING ${ending} 1 -1 ending)
  list(FIND types ${ending} at)
  math(EXPR at "${at} + 1")
  list(GET types ${at} type)
  set(path "/${name}")
  if(name STREQUAL "index.html")
    set(path "/")
  endif()
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(APPEND arrays "constexpr unsigned char kFile${count}[] = {${bytes}};\n")
  string(APPEND list "      {\"${path}\", \"${type}\", kFile${count}},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(WRITE ${OUT} "// Made by embed.cmake.
#include \"remote/page.h\"

namespace robosim {
namespace {

${arrays}
}  // namespace

std::vector<WebFile> pageFiles() {
  return {
${list}  };
}

}  // namespace robosim
")
