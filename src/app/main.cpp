#include "app/run.h"

int main(int argc, char** argv) {
  return static_cast<int>(yat::run(argc, argv));
}
