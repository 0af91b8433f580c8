# Run at every build (cmake -P): writes build_info.cpp with the commit that the sources stand at. The file is touched only
# if something changed, so that a build without news links nothing anew.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE commit RESULT_VARIABLE code
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(dirty false)
if(NOT code EQUAL 0)
  set(commit unknown)
else()
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty true)
  endif()
endif()
file(STRINGS ${BINARY}/libraries.txt lines)
set(libraries "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^([^ ]+) (.*)$" "{\"\\1\", \"\\2\"}" item "${line}")
  list(APPEND libraries "${item}")
endforeach()
list(JOIN libraries ", " libraries)
file(CONFIGURE OUTPUT ${BINARY}/generated/build_info.cpp @ONLY CONTENT [=[
#include "nlmech/scene/build_info.hpp"

namespace nlmech::scene {

const BuildInfo& build_info() {
  static const BuildInfo info{
      "@VERSION@", "@commit@", @dirty@, "@COMPILER@", "@FLAGS@", {@libraries@}, "@SOURCE@"};
  return info;
}

}  // namespace nlmech::scene
]=])
