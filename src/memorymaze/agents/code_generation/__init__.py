"""The paper's agent: a language model writes one program, and the robot runs it."""

from memorymaze.agents.code_generation.agent import CodeGenerationAgent
from memorymaze.agents.code_generation.options import CodeGenerationOptions
from memorymaze.agents.code_generation.requests import CodeGenerationRequests

__all__ = ["CodeGenerationAgent", "CodeGenerationOptions", "CodeGenerationRequests"]
