"""How floors, walls and things look: meshes and pictures made by code, no renderer."""
