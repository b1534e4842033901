"""The paper's agent: a language model writes one program, and the robot runs it."""

from memorymaze.agents.code_generation.agent import CodeGenerationAgent
from memorymaze.agents.code_generation.requests import (
    CodeGenerationOptions,
    CodeGenerationRequests,
)

__all__ = ["CodeGenerationAgent", "CodeGenerationOptions", "CodeGenerationRequests"]
