// Ctrl-C and a polite kill ask the rendering to stop, so that it can write the image so far.
#pragma once

namespace meniscal {

// From now on SIGINT and SIGTERM set the flag below; the second of its kind ends the program at once.
void catch_interrupts();

// True once a signal has come: to be polled between dispatches.
bool interrupted();

}  // namespace meniscal
