// `when (condition) { ... }` is an `if` written as a loop of at most one turn. It saves nothing: software rasterizers run
// the body of every `if` under a mask, and their loops are do-while, so a body that no lane needs is paid in full either
// way. What is rare belongs behind the loop around it; see tracing/README.md. Hardware compilers see an `if`.
#define when(condition) for (bool pending = (condition); pending; pending = false)
