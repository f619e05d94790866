//! One page to try things on: a scene, a scheme and its parameters, and what each step does.
