#include "apps/program.h"

int main(int argc, char** argv) { return halfsilver::runProgram(argc, argv); }
