# Runs a benchmark program briefly, on the piston's smallest size and on a generated file, and checks that its JSON has
# rates and no errors.
#
#   cmake -DPROGRAM=... -DFOLDER=... -P smoke_test.cmake    FOLDER: where the file is written

# A cube, each side of 4 x 4 squares.
set(corners "")
set(squares "")
set(count 0)
foreach(axis RANGE 2)
  foreach(side 0 4)
    foreach(i RANGE 3)
      foreach(j RANGE 3)
        foreach(corner 0,0 1,0 1,1 0,1)
          string(REPLACE "," ";" corner ${corner})
          list(GET corner 0 x)
          list(GET corner 1 y)
          math(EXPR x "${x} + ${i}")
          math(EXPR y "${y} + ${j}")
          set(point ${x} ${y})
          list(INSERT point ${axis} ${side})
          list(JOIN point " " point)
          string(APPEND corners "${point}\n")
        endforeach()
        math(EXPR last "${count} + 3")
        math(EXPR second "${count} + 1")
        math(EXPR third "${count} + 2")
        string(APPEND squares "4 ${count} ${second} ${third} ${last}\n")
        math(EXPR count "${count} + 4")
      endforeach()
    endforeach()
  endforeach()
endforeach()
math(EXPR faces "${count} / 4")
get_filename_component(name ${PROGRAM} NAME)
set(file ${FOLDER}/${name}-cube.off)
file(WRITE ${file} "OFF\n${count} ${faces} 0\n${corners}${squares}")

execute_process(
  COMMAND ${PROGRAM} --input ${file} --benchmark_filter=/piston/5000$|cube.off$ --benchmark_min_time=0.01
          --benchmark_repetitions=1 --benchmark_format=json
  OUTPUT_VARIABLE json RESULT_VARIABLE exit_code)
if(NOT exit_code EQUAL 0)
  message(FATAL_ERROR "exit code ${exit_code}:\n${json}")
endif()
string(JSON count LENGTH ${json} benchmarks)
if(count LESS 2)
  message(FATAL_ERROR "only ${count} results:\n${json}")
endif()
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON rate GET ${json} benchmarks ${i} vertices/s)  # fatal if there is none
  if(NOT rate GREATER 0)
    message(FATAL_ERROR "a rate of ${rate}:\n${json}")
  endif()
endforeach()
