"""Where feature points go on a face: predicted from some of them, mirrored, doubted, guessed from nothing."""
