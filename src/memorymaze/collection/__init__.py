"""Collecting what people say of instructions: labels, agreement, consensus."""
