# cmake -DOUTPUT=file.cpp "-DINPUTS=a.lua;b.lua" -P embed.cmake: makes the parts of the language written in Lua part of the program.
set(text "// Made by lua/masonry/embed.cmake from the .lua files beside it.\n#include \"lua/masonry/embedded.h\"\n\nnamespace erbs::lua {\n\nconst std::vector<Embedded>& embedded() {\n  static const std::vector<Embedded> files = {\n")
foreach(input IN LISTS INPUTS)
  file(READ ${input} content)
  get_filename_component(name ${input} NAME)
  string(APPEND text "      {\"${name}\", R\"lua~(${content})lua~\"},\n")
endforeach()
string(APPEND text "  };\n  return files;\n}\n\n}  // namespace erbs::lua\n")
file(WRITE ${OUTPUT} "${text}")
