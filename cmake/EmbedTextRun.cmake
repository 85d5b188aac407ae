file(READ ${IN} hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
file(WRITE ${OUT}.part "#include <string_view>\n\nnamespace outrider::${SPACE} {\n"
  "static constexpr char bytes[] = {${bytes}'\\0'};\n"
  "extern const std::string_view ${NAME};\n"
  "const std::string_view ${NAME}{bytes, sizeof bytes - 1};\n}\n")
file(RENAME ${OUT}.part ${OUT})
