"""Time, state, modes: the engine that every trajectory but the stone pile's runs on."""
