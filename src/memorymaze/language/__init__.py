"""Language models, recorded replies, prompts, and the sandbox for their programs."""
