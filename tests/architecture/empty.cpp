// Given to the compiler with one header in front of it.
