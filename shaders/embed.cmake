# Writes HEADER, which defines the array NAME of the words of SPIRV, a file of little-endian ones.
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${HEADER} "const uint32_t ${NAME}[] = {${words}};\n")
